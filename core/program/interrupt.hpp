#pragma once

#include <atomic>

namespace touchdown {

/// Installs signal handlers: the first Ctrl-C (or SIGTERM, or SIGHUP of a terminal that closes)
/// requests a stop, the second one kills. Under `nohup`, SIGHUP stays ignored. A write
/// beyond `ulimit -f` fails with an error in place of a signal. The returned flag becomes true on
/// the request. Call it first, because until then a signal kills.
const std::atomic<bool>& stop_on_interrupt();

}  // namespace touchdown
