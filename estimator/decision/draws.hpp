#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace touchdown {

/// Random draws that are the same with every standard library.
class Draws {
 public:
  explicit Draws(std::uint64_t seed) : engine_(seed) {}

  /// From [0, 1).
  double uniform() { return static_cast<double>(engine_() >> 11U) * 0x1p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// From 0 to `count` − 1.
  std::uint64_t below(std::uint64_t count) {
    return static_cast<std::uint64_t>(uniform() * static_cast<double>(count));
  }
  /// Normal, of zero mean and unit variance, by Box and Muller.
  double normal() {
    if (is_kept_) {
      is_kept_ = false;
      return kept_;
    }
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    const double angle = 2.0 * std::numbers::pi * uniform();
    kept_ = radius * std::sin(angle);
    is_kept_ = true;
    return radius * std::cos(angle);
  }

 private:
  std::mt19937_64 engine_;
  double kept_ = 0.0;
  bool is_kept_ = false;
};

}  // namespace touchdown
