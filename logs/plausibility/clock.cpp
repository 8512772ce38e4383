#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "logs/plausibility/check.hpp"

namespace touchdown::logs {

namespace {

constexpr std::size_t rate_window = 200;  // times
/// A window of stamps that are rounded to a tick of 10 ms differs by 5 % at 1 kHz.
constexpr double rate_difference = 0.1;
constexpr double jump = 1.0;  // s

std::string times(std::int64_t count) {
  return count == 1 ? "once" : fmt::format("{} times", count);
}

}  // namespace

void ClockCheck::add(double time) {
  if (!std::isfinite(time)) return;
  ++records_;
  fractions_.add(start_ + time);
  const double step = time - std::exchange(previous_, time);
  if (step == 0.0) ++repeated_;
  if (step > 0.0) tick_ = tick_ == 0.0 ? step : std::min(tick_, step);
  if (step < 0.0) {
    ++back_;
    furthest_back_ = std::max(furthest_back_, -step);
  }
  if (step > jump) {
    ++jumps_;
    longest_jump_ = std::max(longest_jump_, step);
  }
  if (step < 0.0 || step > jump) window_.clear();
  window_.push_back(time);
  if (window_.size() >= rate_window) end_window();
}

void ClockCheck::end_window() {
  const double start = window_.front();
  const double step = typical_step(window_).value_or(period_);
  const std::string interleaved = interleaved_clocks(window_);
  window_.clear();
  ++windows_;
  if (!interleaved.empty() && interleaved_windows_++ == 0) interleaved_ = interleaved;
  if (std::abs(step / period_ - 1.0) <= rate_difference) return;
  if (other_rate_++ == 0) {
    first_other_ = start;
    other_step_ = step;
  }
}

void ClockCheck::report_repeated(Findings& findings) const {
  if (repeated_ == 0) return;
  constexpr double often = 0.3;  // of the records
  const double share = static_cast<double>(repeated_) / static_cast<double>(records_);
  if (share < often) {
    findings.add("time", fmt::format("is that of the record before {}: a coarse clock, or records "
                                     "that were written twice",
                                     times(repeated_)));
    return;
  }
  // Numbers in binary lose powers of two, of seconds or of nanoseconds; texts lose digits.
  const auto is_power_of = [this](double base, double unit) {
    const double power = std::log(tick_ / unit) / std::log(base);
    return std::abs(power - std::round(power)) < 1e-3;
  };
  const bool is_decimal = is_power_of(10.0, 1.0);
  const bool is_binary = !is_decimal && (is_power_of(2.0, 1.0) || is_power_of(2.0, 1e-9));
  findings.add(
      "time",
      fmt::format("is that of the record before {}: it has steps of {:.4g} s, and {} records "
                  "share each: {}",
                  times(repeated_), tick_, readable(1.0 / (1.0 - share), 3),
                  is_binary ? "did a float lose its digits? Write nanoseconds as whole numbers, or "
                              "times from the start of the log"
                  : tick_ > 0.5 ? "are stamps truncated to seconds? Map the column of nanoseconds, "
                                  "or a `period`"
                                : "are stamps truncated? Write more digits, or map a `period`"));
}

void ClockCheck::report(Findings& findings) const {
  const auto add = [&](const std::string& finding) { findings.add("time", finding); };
  if (2 * interleaved_windows_ > windows_) add(interleaved_);
  if (other_rate_ > 0) {
    add(
        fmt::format("the rate changes: {} Hz at {} s, {} Hz at the beginning; {:.0f} % "
                    "of the log have another rate: split it, or resample it",
                    readable(1.0 / other_step_, 4), fixed(first_other_, 3),
                    readable(nominal_rate(1.0 / period_), 4),
                    100.0 * static_cast<double>(other_rate_) / static_cast<double>(windows_)));
  }
  report_repeated(findings);
  if (fractions_.count() > 0) {
    add(fmt::format("goes back {}, {}", times(back_), fractions_.text()));
  } else if (back_ > 0) {
    add(fmt::format("goes back {}, by up to {} s: sort the log, or split it", times(back_),
                    readable(furthest_back_, 3)));
  }
  if (jumps_ > 0) {
    add(fmt::format("jumps {}, by up to {} s: recording was interrupted, or the clock was set",
                    times(jumps_), readable(longest_jump_, 3)));
  }
}

}  // namespace touchdown::logs
