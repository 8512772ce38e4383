#include "core/progress.hpp"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <ctime>
#include <unistd.h>

#include <fmt/format.h>

#include "core/terminal_text.hpp"

namespace touchdown {

namespace {

constexpr std::chrono::milliseconds terminal_interval(100);
constexpr std::chrono::seconds plain_interval(5);
constexpr std::int64_t bar_width = 28;

std::string bar(std::int64_t done, std::int64_t total) {
  const std::int64_t full = total > 0 ? bar_width * std::min(done, total) / total : bar_width;
  return fmt::format("{:━<{}}{:╌<{}}", "", full, "", bar_width - full);
}

std::string duration(double seconds) {
  if (seconds < 60.0) return fmt::format("{:.0f} s", seconds);
  const auto whole = static_cast<std::int64_t>(seconds);
  return fmt::format("{} min {:02} s", whole / 60, whole % 60);
}

/// Blocks SIGPIPE for this thread: a write to a broken pipe fails and does not end the program.
class WithoutBrokenPipe {
 public:
  WithoutBrokenPipe() {
    ::sigemptyset(&broken_pipe_);
    ::sigaddset(&broken_pipe_, SIGPIPE);
    ::pthread_sigmask(SIG_BLOCK, &broken_pipe_, &before_);
  }
  ~WithoutBrokenPipe() {
    // A SIGPIPE of a write is pending for this thread. Consume it before the mask is restored.
    const timespec no_wait{};
    if (::sigismember(&before_, SIGPIPE) == 0) ::sigtimedwait(&broken_pipe_, nullptr, &no_wait);
    ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  WithoutBrokenPipe(const WithoutBrokenPipe&) = delete;
  WithoutBrokenPipe& operator=(const WithoutBrokenPipe&) = delete;

 private:
  sigset_t broken_pipe_{};
  sigset_t before_{};
};

void write_to_terminal(std::string_view text) {
  const WithoutBrokenPipe guard;
  while (!text.empty()) {
    const ssize_t size = ::write(STDERR_FILENO, text.data(), text.size());
    if (size < 0 && errno == EINTR) continue;
    if (size <= 0) return;
    text.remove_prefix(static_cast<std::size_t>(size));
  }
}

}  // namespace

void print_message(std::string_view text) { write_to_terminal(terminal_text(text, "\n")); }

Progress::Progress(std::string what, std::string unit, std::int64_t total)
    : what_(std::move(what)),
      unit_(std::move(unit)),
      total_(total),
      terminal_(::isatty(STDERR_FILENO) == 1),
      start_(Clock::now()),
      shown_(start_) {}

Progress::~Progress() {
  const std::scoped_lock lock(mutex_);
  if (done_ > 0) show(Clock::now(), true);
}

void Progress::advance(std::int64_t units) {
  const std::scoped_lock lock(mutex_);
  done_ += units;
  const auto now = Clock::now();
  const auto since = now - shown_;
  if (terminal_ ? since < terminal_interval : since < plain_interval) return;
  shown_ = now;
  show(now, false);
}

void Progress::skip(std::int64_t units) {
  {
    const std::scoped_lock lock(mutex_);
    skipped_ += units;
  }
  advance(units);
}

void Progress::show(Clock::time_point now, bool last) {
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const double rate = elapsed > 0.0 ? static_cast<double>(done_ - skipped_) / elapsed : 0.0;
  std::string state = fmt::format("{}/{} {}", done_, total_, unit_);
  if (last) {
    if (skipped_ > 0) state += fmt::format(" ({} of them done before)", skipped_);
    state += fmt::format(" in {}", duration(elapsed));
  } else if (rate > 0.0) {
    state += fmt::format(", {:.3g}/s, {} left", rate,
                         duration(static_cast<double>(total_ - done_) / rate));
  }
  if (terminal_) {
    write_to_terminal(fmt::format("\r\x1b[K{:<14} {} {}{}", terminal_text(what_),
                                  bar(done_, total_), state, last ? "\n" : ""));
  } else {
    print_message(fmt::format("{}: {}\n", what_, state));
  }
}

}  // namespace touchdown
