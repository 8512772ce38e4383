#pragma once

#include <cstdint>
#include <span>

namespace touchdown {

/// P(1 | x) = 1 / (1 + exp(−(slope x + intercept))).
struct LogisticCurve {
  double slope = 0.0;
  double intercept = 0.0;

  bool operator==(const LogisticCurve&) const = default;

  [[nodiscard]] double operator()(double x) const noexcept;
};

/// The maximum likelihood curve, by Newton's method: the minimum over slope and intercept of
///
///     1/n Σ_i log(1 + exp(−y_i (slope x_i + intercept))) + ridge/2 (slope · s)²,   y_i = ±1,
///
/// with s the standard deviation of x. A small ridge keeps the slope finite if one value of x
/// separates the classes. `is_one` is 0 or 1 for each x. Throws InputError for sequences of
/// different lengths, values that are not finite, a single class, and a negative ridge.
[[nodiscard]] LogisticCurve fit_logistic(std::span<const double> x,
                                         std::span<const std::uint8_t> is_one, double ridge = 1e-6);

}  // namespace touchdown
