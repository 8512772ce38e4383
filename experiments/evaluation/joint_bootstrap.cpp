#include "experiments/evaluation/joint_bootstrap.hpp"

#include <algorithm>
#include <span>

#include "core/random.hpp"
#include "core/rows.hpp"

namespace touchdown::experiments {

namespace {

constexpr std::uint64_t run_stream = 0x72756e73ULL << 32U;    // "runs"
constexpr std::uint64_t fit_stream = 0x66697473ULL << 32U;    // "fits"
constexpr std::uint64_t scene_stream = 0x7363656eULL << 32U;  // "scen"

std::size_t drawn(std::size_t count, double u) {
  return static_cast<std::size_t>(u * static_cast<double>(count));
}

}  // namespace

std::uint64_t stream_of(std::size_t scene, const std::string& simulator,
                        const Experiment& experiment) {
  const std::vector<std::string>& engines = experiment.simulators;
  const auto engine = std::find(engines.begin(), engines.end(), simulator) - engines.begin();
  return scene * engines.size() + static_cast<std::size_t>(engine);
}

namespace {

using Fits = std::span<const std::vector<scoring::Classification>>;

double mean_accuracy(const Fits& fits) {
  double sum = 0.0;
  for (const auto& fit : fits) sum += scoring::sum(fit).balanced_accuracy();
  return sum / static_cast<double>(fits.size());
}

/// A bootstrap over runs and these fits. Subtracts `bias` from all values but the estimate; a share
/// stays between 0 and 1.
Resampled resampled(double estimate, const Fits& fits, double bias, std::uint64_t scene,
                    const scoring::BootstrapConfig& bootstrap) {
  Resampled result{estimate};
  const auto centred = [bias](const scoring::Classification& counts) {
    return std::clamp(counts.balanced_accuracy() - bias, 0.0, 1.0);  // NaN stays NaN
  };
  const std::size_t runs = fits.front().size();
  for (std::uint64_t r = 0; r < static_cast<std::uint64_t>(bootstrap.resamples); ++r) {
    if (bootstrap.before_resamples && r % 256 == 0) bootstrap.before_resamples();
    const auto& scored = fits[drawn(fits.size(), uniform01(bootstrap.seed, fit_stream, r))];
    result.of_fits.push_back(centred(scoring::sum(scored)));
    if (runs < 2) continue;
    scoring::Classification sum;
    for (std::size_t i = 0; i + 1 < runs; ++i) {
      sum += scored[drawn(runs, uniform01(bootstrap.seed, run_stream + scene, r * runs + i))];
    }
    result.values.push_back(centred(sum));
  }
  return result;
}

}  // namespace

Resampled balanced_accuracy(const CountsByFit& by_fit, std::uint64_t scene,
                            const scoring::BootstrapConfig& bootstrap) {
  const double estimate = scoring::sum(by_fit.front()).balanced_accuracy();
  const Fits refits = Fits(by_fit).subspan(1);
  if (refits.empty()) return resampled(estimate, by_fit, 0.0, scene, bootstrap);
  return resampled(estimate, refits, mean_accuracy(refits) - estimate, scene, bootstrap);
}

Resampled balanced_accuracy_of_fits(const CountsByFit& by_fit, std::uint64_t scene,
                                    const scoring::BootstrapConfig& bootstrap) {
  return resampled(mean_accuracy(by_fit), by_fit, 0.0, scene, bootstrap);
}

/// The sum of lists with weights, as long as the shortest one.
static std::vector<double> sum_of(const std::vector<const Resampled*>& all, double weight,
                                  std::vector<double> Resampled::*list) {
  if (all.empty()) return {};
  std::vector<double> sum((all.front()->*list).size());
  for (const Resampled* one : all) {
    sum.resize(std::min(sum.size(), (one->*list).size()));
    for (std::size_t r = 0; r < sum.size(); ++r) sum[r] += weight * (one->*list)[r];
  }
  return sum;
}

Resampled mean(const std::vector<const Resampled*>& all) {
  const double share = 1.0 / static_cast<double>(all.size());
  Resampled result{0.0, sum_of(all, share, &Resampled::values),
                   sum_of(all, share, &Resampled::of_fits)};
  for (const Resampled* one : all) result.estimate += share * one->estimate;
  return result;
}

Resampled mean_over_scenes(const std::vector<SceneValues>& scenes,
                           const scoring::BootstrapConfig& bootstrap) {
  std::vector<const Resampled*> all;
  for (const SceneValues& scene : scenes) {
    for (const Resampled& value : scene) all.push_back(&value);
  }
  Resampled result = mean(all);
  const std::size_t count = scenes.size();
  if (count < 2) return result;
  result.values.clear();
  for (std::uint64_t r = 0; r < static_cast<std::uint64_t>(bootstrap.resamples); ++r) {
    double sum = 0.0;
    double weight = 0.0;
    for (std::size_t i = 0; i + 1 < count; ++i) {
      const double u = uniform01(bootstrap.seed, scene_stream, r * count + i);
      for (const Resampled& value : scenes[drawn(count, u)]) {
        sum += r < value.of_fits.size() ? value.of_fits[r] : value.estimate;
        weight += 1.0;
      }
    }
    result.values.push_back(sum / weight);
  }
  return result;
}

Resampled operator-(const Resampled& first, const Resampled& second) {
  Resampled difference{first.estimate - second.estimate};
  for (std::size_t r = 0; r < std::min(first.values.size(), second.values.size()); ++r) {
    difference.values.push_back(first.values[r] - second.values[r]);
  }
  for (std::size_t r = 0; r < std::min(first.of_fits.size(), second.of_fits.size()); ++r) {
    difference.of_fits.push_back(first.of_fits[r] - second.of_fits[r]);
  }
  return difference;
}

Interval interval_of(const Resampled& resampled, double level) {
  std::vector<double> values = resampled.values;
  return scoring::percentile_interval(resampled.estimate, values, level);
}

std::vector<SceneValues> balanced_accuracies(const EstimatorRows& rows,
                                             const Experiment& experiment) {
  std::vector<SceneValues> scenes;
  const auto scene_in = [&](const auto* row) { return scene_of(*row->run, experiment); };
  for (const auto& [scene, in_scene] : group_by(rows, scene_in)) {
    SceneValues& values = scenes.emplace_back();
    const auto engine = [](const auto* row) { return row->run->simulator; };
    for (const auto& [simulator, alike] : group_by(in_scene, engine)) {
      CountsByFit fits;
      for (const auto& fit : group_by(alike, [](const auto* row) { return row->condition; })) {
        std::vector<scoring::Classification>& points = fits.emplace_back();
        for (const auto* row : fit.rows) points.push_back(row->score.wheels().points);
      }
      values.push_back(balanced_accuracy(fits, stream_of(scene, simulator, experiment),
                                         experiment.intervals.bootstrap));
    }
  }
  return scenes;
}

}  // namespace touchdown::experiments
