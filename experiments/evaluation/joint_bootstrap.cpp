#include "experiments/evaluation/joint_bootstrap.hpp"

#include <algorithm>
#include <utility>

#include "core/random.hpp"

namespace touchdown::experiments {

namespace {

constexpr std::uint64_t run_stream = 0x72756e73ULL << 32U;  // "runs"
constexpr std::uint64_t fit_stream = 0x66697473ULL << 32U;  // "fits"

std::size_t drawn(std::size_t count, double u) {
  return static_cast<std::size_t>(u * static_cast<double>(count));
}

}  // namespace

FitsAndRuns fits_and_runs(std::vector<std::vector<scoring::Classification>> by_fit) {
  FitsAndRuns scores;
  if (by_fit.empty()) return scores;
  scores.runs = std::move(by_fit.front());
  by_fit.erase(by_fit.begin());
  scores.of_refit = std::move(by_fit);
  return scores;
}

Resampled balanced_accuracy(const FitsAndRuns& scores, std::uint64_t scene,
                            const scoring::BootstrapConfig& bootstrap) {
  Resampled result{scoring::sum(scores.runs).balanced_accuracy()};
  const std::size_t runs = scores.runs.size();
  const auto resamples = static_cast<std::uint64_t>(runs < 2 ? 0 : bootstrap.resamples);
  for (std::uint64_t r = 0; r < resamples; ++r) {
    if (bootstrap.before_resamples && r % 256 == 0) bootstrap.before_resamples();
    const std::size_t refits = scores.of_refit.size();
    const auto& scored =
        refits == 0 ? scores.runs
                    : scores.of_refit[drawn(refits, uniform01(bootstrap.seed, fit_stream, r))];
    scoring::Classification sum;
    for (std::size_t i = 0; i + 1 < runs; ++i) {
      sum += scored[drawn(runs, uniform01(bootstrap.seed, run_stream + scene, r * runs + i))];
    }
    result.values.push_back(sum.balanced_accuracy());
  }
  return result;
}

Resampled mean(const std::vector<const Resampled*>& all) {
  Resampled result;
  std::size_t resamples = all.empty() ? 0 : all.front()->values.size();
  for (const Resampled* one : all) resamples = std::min(resamples, one->values.size());
  result.values.resize(resamples);
  const double share = 1.0 / static_cast<double>(all.size());
  for (const Resampled* one : all) {
    result.estimate += share * one->estimate;
    for (std::size_t r = 0; r < resamples; ++r) result.values[r] += share * one->values[r];
  }
  return result;
}

Resampled operator-(const Resampled& first, const Resampled& second) {
  Resampled difference{first.estimate - second.estimate};
  for (std::size_t r = 0; r < std::min(first.values.size(), second.values.size()); ++r) {
    difference.values.push_back(first.values[r] - second.values[r]);
  }
  return difference;
}

Interval interval_of(const Resampled& resampled, double level) {
  std::vector<double> values = resampled.values;
  return scoring::percentile_interval(resampled.estimate, values, level);
}

}  // namespace touchdown::experiments
