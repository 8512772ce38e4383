#include "core/progress.hpp"

#include <algorithm>
#include <cstdio>
#include <unistd.h>

#include <fmt/format.h>

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

}  // namespace

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
    if (skipped_ > 0) state += fmt::format(" ({} of them were there)", skipped_);
    state += fmt::format(" in {}", duration(elapsed));
  } else if (rate > 0.0) {
    state += fmt::format(", {:.3g}/s, {} left", rate,
                         duration(static_cast<double>(total_ - done_) / rate));
  }
  if (terminal_) {
    fmt::print(stderr, "\r\x1b[K{:<14} {} {}{}", what_, bar(done_, total_), state,
               last ? "\n" : "");
  } else {
    fmt::print(stderr, "{}: {}\n", what_, state);
  }
  std::fflush(stderr);
}

}  // namespace touchdown
