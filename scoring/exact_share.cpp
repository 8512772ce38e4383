#include "scoring/exact_share.hpp"

#include <cmath>
#include <limits>

namespace touchdown::scoring {

namespace {

/// The probability of at most `most` successes.
double at_most(std::int64_t most, std::int64_t trials, double share) {
  const auto n = static_cast<double>(trials);
  double sum = 0.0;
  for (std::int64_t i = 0; i <= most; ++i) {
    const auto k = static_cast<double>(i);
    sum += std::exp(std::lgamma(n + 1.0) - std::lgamma(k + 1.0) - std::lgamma(n - k + 1.0) +
                    k * std::log(share) + (n - k) * std::log1p(-share));
  }
  return sum;
}

/// The share at which at most `most` successes have this probability.
double share_at(std::int64_t most, std::int64_t trials, double probability) {
  double low = 0.0;
  double high = 1.0;
  constexpr int halvings = 60;
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (low + high);
    (at_most(most, trials, middle) > probability ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

Interval exact_share(std::int64_t successes, std::int64_t trials, double level) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  if (trials < 1) return {nan, nan, nan};
  const double tail = 0.5 * (1.0 - level);
  return {static_cast<double>(successes) / static_cast<double>(trials),
          successes == 0 ? 0.0 : share_at(successes - 1, trials, 1.0 - tail),
          successes == trials ? 1.0 : share_at(successes, trials, tail)};
}

}  // namespace touchdown::scoring
