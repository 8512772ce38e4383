#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace touchdown::logs {

/// To the nanosecond, also of times since 1970, whose seconds a product with 1e9 would round to a
/// multiple of 256.
std::int64_t nanoseconds(double seconds);

/// The upper one of two in the middle. `values` has at least one.
double median(std::vector<double> values);

/// The time between two samples of a log with these times, in their unit, however the log stamps
/// them: rounded to a coarse tick (2, 3, 2, 3 ms at 400 Hz), with jitter, in bursts (1, 1, 1, 7
/// ms), in pairs of equal times, with lost samples, jumps and steps back. Times that are not finite
/// are left out. Empty if no time is after another one.
std::optional<double> typical_step(std::span<const double> times);

/// What the times show if they are those of several clocks, as when publishers share a topic, or if
/// they come in bursts, as times of receiving do; empty for times of one clock.
std::string interleaved_clocks(std::span<const double> times);

/// Finds times of which the fraction is a count without its leading zeros: 1.9 and 1.10 are 9 and
/// 10 ms after the first second. Where the count gets another digit, time goes back within a
/// second, and its steps become a tenth.
class UnpaddedFractions {
 public:
  void add(double time);
  /// How often the count got another digit.
  int count() const { return count_; }
  std::string text() const;

 private:
  double previous_ = 0.0;
  double step_ = 0.0;      ///< the last one
  double expected_ = 0.0;  ///< the next step, after a count that may have got a digit; else 0
  double before_ = 0.0;    ///< the fractions where the last one may have got it
  double after_ = 0.0;
  int count_ = 0;
};

/// Rates are equal if they differ by less than this share.
inline constexpr double rate_tolerance = 0.01;

/// The rate (Hz) that a logger with this measured rate was set to, if it is within `rate_tolerance`
/// of one in use: a whole number of half milliseconds per step, or a multiple of 50 Hz. Otherwise
/// the measured rate.
double nominal_rate(double measured);

/// The unit of times with this step between samples, if it is unlikely to be the second:
/// "milliseconds", "microseconds" or "nanoseconds"; empty otherwise. Logs have 100 to 20,000
/// samples per second, so these units do not overlap.
std::string unit_of_step(double step);

/// The same for samples that are known to be `period` (s) apart: the unit in which the step is a
/// tenth of it to ten times as long; empty for seconds and for any other step.
std::string unit_of_step(double step, double period);

}  // namespace touchdown::logs
