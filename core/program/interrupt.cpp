#include "core/program/interrupt.hpp"

#include <csignal>

namespace touchdown {

namespace {

// Signal handlers can access globals only.
std::atomic<bool> stop_requested = false;
static_assert(std::atomic<bool>::is_always_lock_free);

void request_stop(int /*signal*/) { stop_requested = true; }

}  // namespace

const std::atomic<bool>& stop_on_interrupt() {
  struct sigaction action = {};
  action.sa_handler = request_stop;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before = {};
    ::sigaction(signal, nullptr, &before);
    // `nohup` lets programs ignore SIGHUP. Scripts let jobs in the background ignore SIGINT, which
    // has to stop these all the same.
    const bool is_unwanted = signal == SIGHUP && before.sa_handler == SIG_IGN;
    if (!is_unwanted) ::sigaction(signal, &action, nullptr);
  }
  ::signal(SIGXFSZ, SIG_IGN);
  return stop_requested;
}

}  // namespace touchdown
