#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>

namespace touchdown {

/// Says something on standard error: all of it or, where that is full, closed, or a pipe that
/// nobody reads, less. It never fails and never stops anything.
void tell(std::string_view text);

/// Tells somebody at the terminal how far a long computation is: a bar with rate and time left
/// where standard error is a terminal, a plain line every few seconds elsewhere. Threads may share
/// it.
class Progress {
 public:
  /// `what` is counted in `unit`s, `total` of them.
  Progress(std::string what, std::string unit, std::int64_t total);
  /// Leaves a finished line behind, if there was anything to tell.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void advance(std::int64_t units = 1);
  /// Units that were done before: they count, but say nothing about the rate.
  void skip(std::int64_t units = 1);

 private:
  using Clock = std::chrono::steady_clock;

  void show(Clock::time_point now, bool last);

  const std::string what_;
  const std::string unit_;
  const std::int64_t total_;
  const bool terminal_;
  const Clock::time_point start_;
  std::mutex mutex_;
  std::int64_t done_ = 0;
  std::int64_t skipped_ = 0;
  Clock::time_point shown_;
};

}  // namespace touchdown
