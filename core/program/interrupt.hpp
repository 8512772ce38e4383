#pragma once

#include <atomic>

namespace touchdown {

/// From now on, the first Ctrl-C (or SIGTERM) asks to stop, the second one kills. What is returned
/// becomes true when that is asked.
const std::atomic<bool>& stop_on_interrupt();

}  // namespace touchdown
