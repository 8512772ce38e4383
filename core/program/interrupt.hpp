#pragma once

#include <atomic>

namespace touchdown {

/// Installs signal handlers: the first Ctrl-C (or SIGTERM, or SIGHUP of a terminal that closes)
/// requests a stop, the second one kills. Under `nohup`, SIGHUP stays ignored. A write
/// beyond `ulimit -f` fails with an error in place of a signal. The returned flag becomes true on
/// the request. Call it first: until then a signal kills, unless the program that started this one
/// has delayed it, as `touchdown` does (cli/launcher).
const std::atomic<bool>& stop_on_interrupt();

/// Delays these signals until `stop_on_interrupt` is called again, also by a program that replaces
/// this one. Without it, a signal would kill that program while its libraries are loaded.
void delay_interrupts();

}  // namespace touchdown
