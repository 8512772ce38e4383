#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/interval.hpp"

namespace touchdown {
class Fields;
}

namespace touchdown::scoring {

/// The sample of a bootstrap interval.
enum class SampleUnit : int { run, drop };

/// "run", "drop".
const std::string& to_text(SampleUnit unit);

struct BootstrapConfig {
  int resamples = 1000;    ///< number of resamples
  double level = 0.95;     ///< nominal coverage of the interval
  std::uint64_t seed = 1;  ///< of the draws
  /// Called every 256 resamples, perhaps from several threads. An exception from it ends the
  /// computation.
  std::function<void()> before_resamples = {};
};

struct IntervalConfig {
  SampleUnit over = SampleUnit::run;
  BootstrapConfig bootstrap;
};

void describe(Fields& fields, IntervalConfig& intervals);

/// Indices of the samples in every resample: row r holds `samples` indices, drawn with replacement
/// and keyed by (seed, r, position). Equal arguments give equal draws.
std::vector<std::uint32_t> resampled_indices(std::size_t samples, const BootstrapConfig& config);

/// The percentile interval of a statistic's values over the resamples. NaN values (the resample had
/// a zero denominator) are left out. `values` is reordered.
Interval percentile_interval(double estimate, std::vector<double>& values, double level);

/// Corrects the interval of a share that is 0 or 1 over `events` events. All resamples then give
/// the same share, so the bootstrap's inner end is replaced by the exact one of Clopper and Pearson
/// (1934), which assumes independent events, where that is wider. Other intervals stay unchanged.
Interval with_exact_end(const Interval& share, std::int64_t events, double level);

template <typename Sample>
Sample sum(const std::vector<Sample>& samples) {
  Sample all{};
  for (const Sample& sample : samples) all += sample;
  return all;
}

/// Percentile bootstrap (Efron and Tibshirani 1993, ch. 13) of statistics of a sum over independent
/// samples: means, ratios of sums (precision, recall), differences of paired ones. A sample is a
/// run or a drop, never a time step. `Sample` needs a default value and `+=`; each statistic maps a
/// sum of samples to a number. Returns one interval per statistic. All statistics, and all calls
/// with the same number of samples and the same seed, use the same resamples. One sample alone has
/// no interval: its ends are NaN.
template <typename Sample>
std::vector<Interval> bootstrap(std::span<const Sample> samples,
                                const std::vector<std::function<double(const Sample&)>>& statistics,
                                const BootstrapConfig& config) {
  const std::vector<std::uint32_t> indices = resampled_indices(samples.size(), config);
  Sample all{};
  for (const Sample& sample : samples) all += sample;

  // Resamples of one sample are that sample again: it has no interval, not one without width.
  const bool has_interval = samples.size() > 1;
  std::vector<std::vector<double>> values(statistics.size());
  for (std::size_t r = 0; has_interval && samples.size() * r < indices.size(); ++r) {
    if (config.before_resamples && r % 256 == 0) config.before_resamples();
    Sample sum{};
    for (std::size_t i = 0; i < samples.size(); ++i)
      sum += samples[indices[samples.size() * r + i]];
    for (std::size_t s = 0; s < statistics.size(); ++s) values[s].push_back(statistics[s](sum));
  }
  std::vector<Interval> result;
  for (std::size_t s = 0; s < statistics.size(); ++s) {
    result.push_back(percentile_interval(statistics[s](all), values[s], config.level));
  }
  return result;
}

/// Two methods' results on the same run or drop, resampled together for their difference.
template <typename Sample>
struct Paired {
  Sample first{};
  Sample second{};

  Paired& operator+=(const Paired& other) {
    first += other.first;
    second += other.second;
    return *this;
  }
};

template <typename Sample>
std::vector<Paired<Sample>> paired(const std::vector<Sample>& first,
                                   const std::vector<Sample>& second) {
  std::vector<Paired<Sample>> pairs;
  for (std::size_t i = 0; i < first.size(); ++i) pairs.push_back({first[i], second[i]});
  return pairs;
}

/// Interval of each statistic of the first samples minus that of the second, paired by run or drop.
template <typename Sample>
std::vector<Interval> bootstrap_differences(
    const std::vector<Sample>& first, const std::vector<Sample>& second,
    const std::vector<std::function<double(const Sample&)>>& statistics,
    const BootstrapConfig& config) {
  std::vector<std::function<double(const Paired<Sample>&)>> differences;
  for (const auto& of : statistics) {
    differences.emplace_back(
        [of](const Paired<Sample>& pair) { return of(pair.first) - of(pair.second); });
  }
  return bootstrap<Paired<Sample>>(paired(first, second), differences, config);
}

/// The share of successful trials with the exact interval of Clopper and Pearson (1934): the shares
/// for which at least, and at most, that many successes have a probability of (1 − level)/2 or
/// more. Assumes independent trials. NaN without any.
Interval exact_share(std::int64_t successes, std::int64_t trials, double level);

}  // namespace touchdown::scoring
