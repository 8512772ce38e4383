#pragma once

#include <atomic>

#include "core/error.hpp"

namespace touchdown {

/// Ends a reading: throws `Stopped` once `stop` is true. It may be null.
inline void end_if(const std::atomic<bool>* stop) {
  if (stop != nullptr && *stop) throw Stopped("stopped; nothing was written");
}

}  // namespace touchdown
