#include "scoring/bootstrap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/fields.hpp"
#include "core/random.hpp"

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

const std::vector<std::string> unit_names = {"run", "drop"};

/// Linear interpolation between order statistics: quantile 0 is the smallest, 1 the largest value.
double quantile(const std::vector<double>& sorted, double q) {
  const double place = q * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], place - static_cast<double>(below));
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

const std::string& to_text(SampleUnit unit) { return unit_names[static_cast<std::size_t>(unit)]; }

void describe(Fields& fields, IntervalConfig& intervals) {
  fields.choose("over", unit_names, intervals.over)
      .doc("What is resampled: whole runs or single drops.");
  fields("resamples", intervals.bootstrap.resamples, 10, 1'000'000)
      .doc("Number of bootstrap resamples.");
  fields("level", intervals.bootstrap.level, 0.5, 0.999).doc("Nominal coverage of the intervals.");
  fields("seed", intervals.bootstrap.seed).doc("Seed of the resamples.");
}

std::vector<std::uint32_t> resampled_indices(std::size_t samples, const BootstrapConfig& config) {
  const auto resamples = static_cast<std::size_t>(std::max(config.resamples, 0));
  std::vector<std::uint32_t> indices(samples * resamples);
  for (std::size_t r = 0; r < resamples; ++r) {
    for (std::size_t i = 0; i < samples; ++i) {
      const double u = uniform01(config.seed, r, i);
      indices[samples * r + i] = static_cast<std::uint32_t>(u * static_cast<double>(samples));
    }
  }
  return indices;
}

Interval percentile_interval(double estimate, std::vector<double>& values, double level) {
  std::erase_if(values, [](double value) { return std::isnan(value); });
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  if (values.empty() || std::isnan(estimate)) return {estimate, nan, nan};
  std::sort(values.begin(), values.end());
  const double tail = 0.5 * (1.0 - level);
  return {estimate, quantile(values, tail), quantile(values, 1.0 - tail)};
}

Interval with_exact_end(const Interval& share, std::int64_t events, double level) {
  if (events < 1 || std::isnan(share.low)) return share;
  const double reach = std::pow(0.5 * (1.0 - level), 1.0 / static_cast<double>(events));
  if (share.estimate == 1.0) return {1.0, std::fmin(share.low, reach), 1.0};
  if (share.estimate == 0.0) return {0.0, 0.0, std::fmax(share.high, 1.0 - reach)};
  return share;
}

}  // namespace touchdown::scoring
