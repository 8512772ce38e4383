#include "experiments/phase_study/fit.hpp"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "core/error.hpp"
#include "experiments/phase_study/plan.hpp"
#include "experiments/play/pieces.hpp"

namespace touchdown::experiments {

namespace {

std::vector<RunSignals> pieces_with(const Experiment& experiment, const PlayedRuns& runs,
                                    const std::string& simulator, int number) {
  std::vector<FitPieces> pieces = experiment.fit_pieces;
  pieces.front().runs = number;
  return pieces_of(runs, simulator, pieces);
}

double seconds(const std::vector<RunSignals>& pieces) {
  double sum = 0.0;
  for (const RunSignals& piece : pieces) {
    sum += 1e-6 * static_cast<double>(piece.info.control_period_us) *
           static_cast<double>(piece.steps());
  }
  return sum;
}

}  // namespace

void fit_learning_curve(const Experiment& experiment, const PlayedRuns& runs,
                        const GoingOn& going_on, FittedModels& models) {
  constexpr double most_seconds = 60.0;
  Experiment phase_alone = experiment;
  phase_alone.estimators = {"phase"};
  ChosenConstants chosen;  // with all pieces
  for (const std::string& simulator : experiment.simulators) {
    const auto phase = models[simulator].find("phase");
    if (phase != models[simulator].end()) chosen[simulator]["phase"] = phase->second.constants;
  }
  for (const int number : learning_curve) {
    std::vector<RunSignals> all;
    for (const std::string& simulator : experiment.simulators) {
      const double fitted =
          fitted_seconds(experiment, runs, simulator, experiment.fit_pieces.front().runs);
      if (fitted > most_seconds) {
        throw Error(fmt::format("fitted on {:.1f} s, more than {} s", fitted, most_seconds));
      }
      std::vector<RunSignals> pieces = pieces_with(experiment, runs, simulator, number);
      std::move(pieces.begin(), pieces.end(), std::back_inserter(all));
    }
    for (auto& [simulator, by_estimator] : fit_models(phase_alone, {}, all, going_on, chosen)) {
      models[simulator + pieces_fit(number)] = std::move(by_estimator);
    }
  }
}

double fitted_seconds(const Experiment& experiment, const PlayedRuns& runs,
                      const std::string& simulator, int number) {
  return seconds(pieces_with(experiment, runs, simulator, number));
}

}  // namespace touchdown::experiments
