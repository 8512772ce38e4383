#include "experiments/studies/phase_study/fit.hpp"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "core/error.hpp"
#include "experiments/rollouts/training_segments.hpp"
#include "experiments/studies/phase_study/plan.hpp"

namespace touchdown::experiments {

namespace {

std::vector<RunSignals> segments_with(const Experiment& experiment, const Rollouts& runs,
                                      const std::string& simulator, int number) {
  std::vector<TrainingSegments> segments = experiment.training_segments;
  segments.front().runs = number;
  return training_segments_of(runs, simulator, segments);
}

double seconds(const std::vector<RunSignals>& segments) {
  double sum = 0.0;
  for (const RunSignals& segment : segments) {
    sum += 1e-6 * static_cast<double>(segment.info.control_period_us) *
           static_cast<double>(segment.steps());
  }
  return sum;
}

}  // namespace

void fit_learning_curve(const Experiment& experiment, const Rollouts& runs,
                        const ShouldContinue& should_continue, FittedModels& models) {
  constexpr double most_seconds = 60.0;
  Experiment phase_alone = experiment;
  phase_alone.estimators = {"phase"};
  TunedHyperparameters chosen;  // with all segments
  for (const std::string& simulator : experiment.simulators) {
    const auto phase = models[simulator].find("phase");
    if (phase != models[simulator].end())
      chosen[simulator]["phase"] = phase->second.hyperparameters;
  }
  for (const int number : learning_curve) {
    std::vector<RunSignals> all;
    for (const std::string& simulator : experiment.simulators) {
      const double fitted =
          fitted_seconds(experiment, runs, simulator, experiment.training_segments.front().runs);
      if (fitted > most_seconds) {
        throw Error(fmt::format("fitted on {:.1f} s, more than {} s", fitted, most_seconds));
      }
      std::vector<RunSignals> segments = segments_with(experiment, runs, simulator, number);
      std::move(segments.begin(), segments.end(), std::back_inserter(all));
    }
    for (auto& [simulator, by_estimator] :
         fit_models(phase_alone, {}, all, should_continue, chosen)) {
      models[simulator + segments_fit(number)] = std::move(by_estimator);
    }
  }
}

double fitted_seconds(const Experiment& experiment, const Rollouts& runs,
                      const std::string& simulator, int number) {
  return seconds(segments_with(experiment, runs, simulator, number));
}

}  // namespace touchdown::experiments
