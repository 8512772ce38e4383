#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>

namespace touchdown {

/// Prints a message on standard error, as `terminal_text` with line ends. If standard error is
/// full, closed or a broken pipe, the rest of the message is dropped. It never throws and never
/// ends the program.
void print_message(std::string_view text);

/// Shows the progress of a long computation on standard error. A terminal shows a bar with the rate
/// and the remaining time; other streams get a plain line every few seconds. Thread-safe.
class Progress {
 public:
  /// `what` is the computation; its progress is counted in `unit`, `total` in all.
  Progress(std::string what, std::string unit, std::int64_t total);
  /// Prints a final line, unless no unit was done.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void advance(std::int64_t units = 1);
  /// Counts units that an earlier run finished. They do not count towards the rate.
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
