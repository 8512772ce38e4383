#pragma once

#include <atomic>

#include "core/error.hpp"

namespace touchdown::render {

/// Called between two figures or frames. Throws `Stopped` once the user has asked to stop; `stop`
/// may be null.
inline void stop_if_asked(const std::atomic<bool>* stop) {
  if (stop != nullptr && *stop) throw Stopped();
}

}  // namespace touchdown::render
