#include "experiments/evaluation/joint_bootstrap.hpp"

#include <algorithm>
#include <utility>

#include "core/random.hpp"

namespace touchdown::experiments {

namespace {

constexpr std::uint64_t run_stream = 0x72756e73ULL << 32U;    // "runs"
constexpr std::uint64_t fit_stream = 0x66697473ULL << 32U;    // "fits"
constexpr std::uint64_t scene_stream = 0x7363656eULL << 32U;  // "scen"

std::size_t drawn(std::size_t count, double u) {
  return static_cast<std::size_t>(u * static_cast<double>(count));
}

}  // namespace

std::vector<std::size_t> runs_in_scene(const Plan& plan, const Experiment& experiment,
                                       std::size_t group, std::size_t scene) {
  std::vector<std::size_t> runs = plan.runs_in(group);
  std::erase_if(runs,
                [&](std::size_t run) { return scene_of(plan.runs[run], experiment) != scene; });
  return runs;
}

std::vector<CollectedCounts> counts_by_scene(const Evaluation& evaluation, std::size_t group) {
  const Experiment& experiment = evaluation.request.experiment;
  std::vector<CollectedCounts> scenes;
  for (std::size_t scene = 0; scene < experiment.test.scenarios.size(); ++scene) {
    scenes.push_back(collect(evaluation.plan,
                             runs_in_scene(evaluation.plan, experiment, group, scene),
                             evaluation.saved));
  }
  return scenes;
}

std::vector<std::vector<scoring::Classification>> points_by_fit(const CollectedCounts& counts,
                                                                Condition condition,
                                                                std::size_t cell) {
  std::vector<std::vector<scoring::Classification>> fits;
  for (const ConditionScores& scored : counts.scored) {
    if (!(scored.condition == condition)) continue;
    std::vector<scoring::Classification>& points = fits.emplace_back();
    for (const scoring::RobotScore& run : scored.samples[cell]) {
      points.push_back(run.wheels().points);
    }
    ++condition.refit;
  }
  return fits;
}

std::uint64_t stream_of(std::size_t scene, const std::string& simulator,
                        const Experiment& experiment) {
  const std::vector<std::string>& engines = experiment.simulators;
  const auto engine = std::find(engines.begin(), engines.end(), simulator) - engines.begin();
  return scene * engines.size() + static_cast<std::size_t>(engine);
}

FitsAndRuns fits_and_runs(std::vector<std::vector<scoring::Classification>> by_fit) {
  FitsAndRuns scores;
  if (by_fit.empty()) return scores;
  scores.runs = std::move(by_fit.front());
  by_fit.erase(by_fit.begin());
  scores.of_refit = std::move(by_fit);
  return scores;
}

namespace {

/// How much better the refits are than the estimator's own fit, on average over all runs.
double bias_of_refits(const FitsAndRuns& scores, double estimate) {
  if (scores.of_refit.empty()) return 0.0;
  double sum = 0.0;
  for (const auto& refit : scores.of_refit) sum += scoring::sum(refit).balanced_accuracy();
  return sum / static_cast<double>(scores.of_refit.size()) - estimate;
}

/// Subtracts `bias` from all values but the estimate; a share stays between 0 and 1.
Resampled resampled(const FitsAndRuns& scores, double bias, std::uint64_t scene,
                    const scoring::BootstrapConfig& bootstrap) {
  Resampled result{scoring::sum(scores.runs).balanced_accuracy()};
  const auto centred = [bias](const scoring::Classification& counts) {
    return std::clamp(counts.balanced_accuracy() - bias, 0.0, 1.0);  // NaN stays NaN
  };
  const std::size_t runs = scores.runs.size();
  const std::size_t refits = scores.of_refit.size();
  for (std::uint64_t r = 0; r < static_cast<std::uint64_t>(bootstrap.resamples); ++r) {
    if (bootstrap.before_resamples && r % 256 == 0) bootstrap.before_resamples();
    const auto& scored =
        refits == 0 ? scores.runs
                    : scores.of_refit[drawn(refits, uniform01(bootstrap.seed, fit_stream, r))];
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

Resampled balanced_accuracy(const FitsAndRuns& scores, std::uint64_t scene,
                            const scoring::BootstrapConfig& bootstrap) {
  const double estimate = scoring::sum(scores.runs).balanced_accuracy();
  return resampled(scores, bias_of_refits(scores, estimate), scene, bootstrap);
}

Resampled balanced_accuracy_of_fits(const std::vector<std::vector<scoring::Classification>>& by_fit,
                                    std::uint64_t scene,
                                    const scoring::BootstrapConfig& bootstrap) {
  Resampled result = resampled({by_fit.front(), by_fit}, 0.0, scene, bootstrap);
  result.estimate = 0.0;
  for (const auto& fit : by_fit) {
    result.estimate += scoring::sum(fit).balanced_accuracy() / static_cast<double>(by_fit.size());
  }
  return result;
}

Resampled mean(const std::vector<const Resampled*>& all) {
  Resampled result;
  std::size_t resamples = all.empty() ? 0 : all.front()->values.size();
  for (const Resampled* one : all) resamples = std::min(resamples, one->values.size());
  result.values.resize(resamples);
  std::size_t fits = all.empty() ? 0 : all.front()->of_fits.size();
  for (const Resampled* one : all) fits = std::min(fits, one->of_fits.size());
  result.of_fits.resize(fits);
  const double share = 1.0 / static_cast<double>(all.size());
  for (const Resampled* one : all) {
    result.estimate += share * one->estimate;
    for (std::size_t r = 0; r < resamples; ++r) result.values[r] += share * one->values[r];
    for (std::size_t r = 0; r < result.of_fits.size(); ++r) {
      result.of_fits[r] += share * one->of_fits[r];
    }
  }
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

}  // namespace touchdown::experiments
