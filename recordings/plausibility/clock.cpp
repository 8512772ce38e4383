#include "recordings/plausibility/clock.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "recordings/sample_times.hpp"

namespace touchdown::recordings {

namespace {

constexpr std::size_t window_length = 200;  // times
/// A window of stamps that are rounded to a tick of 10 ms differs by 5 % at 1 kHz.
constexpr double rate_difference = 0.1;
constexpr double jump = 1.0;  // s

std::string times(std::int64_t count) {
  return count == 1 ? "once" : fmt::format("{} times", count);
}

}  // namespace

void ClockCheck::add(double time) {
  if (!std::isfinite(time)) return;
  if (is_started_) {
    const double step = time - previous_;
    if (step == 0.0) ++repeated_;
    if (step < 0.0) {
      ++back_;
      furthest_back_ = std::max(furthest_back_, -step);
    }
    if (step > jump) {
      ++jumps_;
      longest_jump_ = std::max(longest_jump_, step);
    }
    if (step < 0.0 || step > jump) window_.clear();
  }
  previous_ = time;
  is_started_ = true;
  window_.push_back(time);
  if (window_.size() >= window_length) end_window();
}

void ClockCheck::end_window() {
  const double start = window_.front();
  const double step = typical_step(window_).value_or(period_);
  window_.clear();
  ++windows_;
  if (std::abs(step / period_ - 1.0) <= rate_difference) return;
  if (other_rate_++ == 0) {
    first_other_ = start;
    other_step_ = step;
  }
}

void ClockCheck::report(Findings& findings) const {
  const auto add = [&](const std::string& finding) { findings.add("time", finding); };
  if (other_rate_ > 0) {
    add(
        fmt::format("the rate changes: {:.4g} Hz at {:.3f} s, {:.4g} Hz at the beginning; {:.0f} % "
                    "of the log have another rate: split it, or resample it",
                    1.0 / other_step_, first_other_, nominal_rate(1.0 / period_),
                    100.0 * static_cast<double>(other_rate_) / static_cast<double>(windows_)));
  }
  if (repeated_ > 0) {
    add(
        fmt::format("is that of the record before {}: a coarse clock, or records that were written "
                    "twice",
                    times(repeated_)));
  }
  if (back_ > 0) {
    add(fmt::format("goes back {}, by up to {:.3g} s: sort the log, or split it", times(back_),
                    furthest_back_));
  }
  if (jumps_ > 0) {
    add(fmt::format("jumps {}, by up to {:.3g} s: recording was interrupted, or the clock was set",
                    times(jumps_), longest_jump_));
  }
}

}  // namespace touchdown::recordings
