#pragma once

#include <cmath>

namespace touchdown {

/// The exact gain of a first-order low-pass: the share of the way to its input that it covers in
/// one step. 1 for a time constant (s) of zero or less.
inline double exact_low_pass_gain(double time_constant, double sample_rate) noexcept {
  return time_constant > 0.0 ? -std::expm1(-1.0 / (sample_rate * time_constant)) : 1.0;
}

}  // namespace touchdown
