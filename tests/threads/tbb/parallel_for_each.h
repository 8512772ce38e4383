#pragma once

#include <tbb/parallel_for.h>

namespace tbb {

template <typename Container, typename Function>
void parallel_for_each(Container& container, const Function& function) {
  parallel_for(std::size_t{0}, container.size(), [&](std::size_t i) { function(container[i]); });
}

}  // namespace tbb
