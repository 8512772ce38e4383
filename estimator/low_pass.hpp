#pragma once

#include <cmath>

namespace touchdown {

/// How far a first-order low-pass goes towards its input in one step, exactly; 1 without a time
/// constant (s).
inline double exact_low_pass_gain(double time_constant, double sample_rate) noexcept {
  return time_constant > 0.0 ? -std::expm1(-1.0 / (sample_rate * time_constant)) : 1.0;
}

}  // namespace touchdown
