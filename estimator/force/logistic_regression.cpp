#include "estimator/force/logistic_regression.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"

namespace touchdown {

namespace {

/// The loss at one point: its value, gradient and curvature along offset and slope of the
/// standardised x.
struct Loss {
  double value = 0.0;
  double offset = 0.0;
  double slope = 0.0;
  double offset_offset = 0.0;
  double offset_slope = 0.0;
  double slope_slope = 0.0;
};

double steepness(const Loss& loss) noexcept {
  return std::max(std::abs(loss.offset), std::abs(loss.slope));
}

struct Standardised {
  std::span<const double> x;
  std::span<const std::uint8_t> is_one;
  double mean;
  double deviation;
  double ridge;

  [[nodiscard]] Loss loss(double offset, double slope) const noexcept {
    Loss sum;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double z = (x[i] - mean) / deviation;
      const double logit = offset + slope * z;
      const double tail = std::exp(-std::abs(logit));
      const double p = (logit >= 0.0 ? 1.0 : tail) / (1.0 + tail);
      const double residual = p - (is_one[i] != 0 ? 1.0 : 0.0);
      const double weight = tail / ((1.0 + tail) * (1.0 + tail));
      const bool is_wrong = (logit >= 0.0) != (is_one[i] != 0);
      sum.value += std::log1p(tail) + (is_wrong ? std::abs(logit) : 0.0);
      sum.offset += residual;
      sum.slope += residual * z;
      sum.offset_offset += weight;
      sum.offset_slope += weight * z;
      sum.slope_slope += weight * z * z;
    }
    const double n = static_cast<double>(x.size());
    return {sum.value / n + 0.5 * ridge * slope * slope,
            sum.offset / n,
            sum.slope / n + ridge * slope,
            sum.offset_offset / n,
            sum.offset_slope / n,
            sum.slope_slope / n + ridge};
  }
};

double mean_of(std::span<const double> x) {
  double sum = 0.0;
  for (const double value : x) sum += value;
  return sum / static_cast<double>(x.size());
}

double deviation_of(std::span<const double> x, double mean) {
  double squares = 0.0;
  for (const double value : x) squares += (value - mean) * (value - mean);
  return std::sqrt(squares / static_cast<double>(x.size()));
}

/// The share of ones.
double checked_share(std::span<const double> x, std::span<const std::uint8_t> is_one,
                     double ridge) {
  if (!(ridge >= 0.0)) throw InputError("logistic regression: the ridge must not be negative");
  if (x.size() != is_one.size()) {
    throw InputError("logistic regression: one class is needed for every value");
  }
  if (!std::all_of(x.begin(), x.end(), [](double value) { return std::isfinite(value); })) {
    throw InputError("logistic regression: values that are fitted must be finite");
  }
  const auto ones = std::count_if(is_one.begin(), is_one.end(), [](auto one) { return one != 0; });
  const auto all = static_cast<std::ptrdiff_t>(x.size());
  if (ones == 0 || ones == all) {
    throw InputError("logistic regression: values of both classes are needed");
  }
  return static_cast<double>(ones) / static_cast<double>(all);
}

}  // namespace

double LogisticCurve::operator()(double x) const noexcept {
  return 1.0 / (1.0 + std::exp(-(slope * x + intercept)));
}

LogisticCurve fit_logistic(std::span<const double> x, std::span<const std::uint8_t> is_one,
                           double ridge) {
  const double share = checked_share(x, is_one, ridge);
  const double mean = mean_of(x);
  const double deviation = deviation_of(x, mean);
  if (!(deviation > 0.0)) return {0.0, std::log(share / (1.0 - share))};
  const Standardised data{x, is_one, mean, deviation, ridge};

  constexpr int most_steps = 200;
  constexpr double flat = 1e-9;
  constexpr double rounding = 1e-15;
  constexpr double least_share = 1e-10;
  double offset = std::log(share / (1.0 - share));
  double slope = 0.0;
  Loss here = data.loss(offset, slope);
  for (int i = 0; i < most_steps; ++i) {
    const double determinant =
        here.offset_offset * here.slope_slope - here.offset_slope * here.offset_slope;
    if (!(determinant > std::numeric_limits<double>::min())) break;
    const double along_offset =
        (here.slope_slope * here.offset - here.offset_slope * here.slope) / determinant;
    const double along_slope =
        (here.offset_offset * here.slope - here.offset_slope * here.offset) / determinant;
    // Halve the step until it does not climb: far from the minimum a whole step may.
    double share_of_step = 1.0;
    Loss there = data.loss(offset - along_offset, slope - along_slope);
    while (!(there.value <= here.value + rounding) && share_of_step > least_share) {
      share_of_step *= 0.5;
      there = data.loss(offset - share_of_step * along_offset, slope - share_of_step * along_slope);
    }
    // Stop where rounding ends the descent: for nearly separable classes, a small gradient can
    // still be far from the minimum.
    if (!(there.value <= here.value + rounding)) break;
    if (steepness(here) <= flat && steepness(there) >= steepness(here)) break;
    offset -= share_of_step * along_offset;
    slope -= share_of_step * along_slope;
    here = there;
  }
  return {slope / deviation, offset - slope * mean / deviation};
}

}  // namespace touchdown
