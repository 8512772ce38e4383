#pragma once

#include <optional>
#include <span>
#include <string>

namespace touchdown::logs {

/// The time between two samples of a log with these times, in their unit, however the log stamps
/// them: rounded to a coarse tick (2, 3, 2, 3 ms at 400 Hz), with jitter, in bursts (3, 7, 3, 7
/// ms), in pairs of equal times, with lost samples, jumps and steps back. Times that are not finite
/// are left out. Empty if no time is after another one.
std::optional<double> typical_step(std::span<const double> times);

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
