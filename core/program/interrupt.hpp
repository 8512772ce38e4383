#pragma once

#include <atomic>

namespace touchdown {

/// Installs signal handlers: the first Ctrl-C (or SIGTERM) requests a stop, the second one kills.
/// The returned flag becomes true on the request.
const std::atomic<bool>& stop_on_interrupt();

}  // namespace touchdown
