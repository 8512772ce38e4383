#pragma once

#include <array>
#include <csignal>

namespace touchdown {

/// Signals that request a stop.
inline constexpr std::array stop_signals = {SIGINT, SIGTERM, SIGHUP};

/// Blocks or unblocks these signals (`SIG_BLOCK`, `SIG_UNBLOCK`). A program that replaces this one
/// inherits the mask: blocked signals reach it once it unblocks them.
inline void mask_stop_signals(int how) {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : stop_signals) sigaddset(&signals, signal);
  ::sigprocmask(how, &signals, nullptr);
}

}  // namespace touchdown
