#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>

namespace tbb {

/// The last instance sets the limit while it lives. Without one, the limit is four threads, on any
/// number of processors: a race needs two.
class global_control {
 public:
  enum parameter { max_allowed_parallelism };
  global_control(parameter, std::size_t threads) : before_(limit().exchange(threads)) {}
  global_control(const global_control&) = delete;
  global_control& operator=(const global_control&) = delete;
  ~global_control() { limit() = before_; }

  static std::size_t threads() { return std::max<std::size_t>(limit(), 1); }

 private:
  static std::atomic<std::size_t>& limit() {
    static std::atomic<std::size_t> threads = 4;
    return threads;
  }
  std::size_t before_;
};

}  // namespace tbb
