#include "experiments/phase_study_fit.hpp"

#include <algorithm>
#include <optional>
#include <span>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "core/error.hpp"
#include "estimator/bayes_filter.hpp"
#include "estimator/measurement_only.hpp"
#include "estimator/neural_estimator.hpp"
#include "estimator/phase_filter.hpp"
#include "estimator/wheel_contact_observer.hpp"
#include "experiments/fitting.hpp"
#include "experiments/neural_network_file.hpp"
#include "experiments/phase_fitting.hpp"
#include "experiments/resources.hpp"
#include "scenarios/engine.hpp"

namespace touchdown {

Runs play_all(const std::string& file, const std::string& engine, std::uint64_t seed,
              std::int64_t first, int count) {
  Scenario scenario = load_scenario(find_resource("scenarios/" + file + ".yaml"));
  scenario.robot = find_resource(scenario.robot);
  scenario.simulation.steps.control_us = 1000;
  std::vector<std::optional<HeardRun>> played(static_cast<std::size_t>(count));
  tbb::parallel_for(0, count, [&](int i) {
    const Recording recording = play(perturbed(scenario, seed, first + i), engine, seed, first + i);
    if (recording.info.outcome == Outcome::fell || recording.info.outcome == Outcome::diverged) {
      return;
    }
    played[static_cast<std::size_t>(i)] = hear(recording, {}, {}, SampleUnit::run);
  });
  Runs runs;
  for (auto& run : played) {
    if (run) runs.push_back(std::move(*run));
  }
  return runs;
}

namespace {

/// Drops what a run's fit does not need: keeps steps [begin, end).
HeardRun cut(const HeardRun& run, std::size_t begin, std::size_t end) {
  HeardRun piece;
  piece.info = run.info;
  const auto first = static_cast<std::ptrdiff_t>(std::min(begin, run.steps()));
  const auto last = static_cast<std::ptrdiff_t>(std::min(end, run.steps()));
  piece.signals.assign(run.signals.begin() + first, run.signals.begin() + last);
  for (std::size_t w = 0; w < wheel_count; ++w) {
    piece.contact[w].assign(run.contact[w].begin() + first, run.contact[w].begin() + last);
    piece.normal_force[w].assign(run.normal_force[w].begin() + first,
                                 run.normal_force[w].begin() + last);
  }
  return piece;
}

/// 1.9 s from one of five places between the first drop and the end, turn by turn.
HeardRun window(const HeardRun& run, std::size_t turn) {
  constexpr std::size_t before_first_drop = 2300;
  constexpr std::size_t length = 1900;
  const std::size_t room = run.steps() - std::min(run.steps(), before_first_drop + length);
  const std::size_t begin = before_first_drop + room * (turn % 5) / 4;
  return cut(run, begin, begin + length);
}

}  // namespace

Fitted fit_on(const std::string& engine, int stairs_runs, double most_seconds) {
  constexpr int whole_runs = 4;
  const Runs stairs =
      play_all("stairs", engine, 1, first_fit_run, std::max(stairs_runs, whole_runs));
  const Runs hang = play_all("hang", engine, 1, first_fit_run, 1);
  const Runs lift = play_all("lift", engine, 1, first_fit_run, 1);
  Runs pieces;
  for (std::size_t i = 0; i < std::min(stairs.size(), static_cast<std::size_t>(stairs_runs)); ++i) {
    pieces.push_back(window(stairs[i], i));
  }
  for (const HeardRun& run : hang) pieces.push_back(cut(run, 300, 5300));
  for (const HeardRun& run : lift) pieces.push_back(cut(run, 300, 7300));
  Fitted fitted;
  std::vector<const HeardRun*> used;
  for (const HeardRun& piece : pieces) {
    fitted.seconds += 1e-3 * static_cast<double>(piece.steps());
    used.push_back(&piece);
  }
  if (fitted.seconds > most_seconds) {
    throw Error(fmt::format("fitted on {:.1f} s, more than {} s", fitted.seconds, most_seconds));
  }
  const auto phase = std::make_shared<PhaseFilter>(fit_phases(used, PhaseFitConfig{}, 0.0));
  fitted.make["phase"] = [phase] { return std::make_unique<PhaseFilter>(*phase); };
  const auto network = std::make_shared<const NeuralNetwork>(shipped_neural_network());
  fitted.make["nmn"] = [network] {
    return std::make_unique<NeuralEstimator>(network, NeuralEstimatorConfig{});
  };
  fitted.make["upkie_observer"] = [] { return std::make_unique<UpkieObserver>(); };
  std::vector<const HeardRun*> whole;
  for (const HeardRun& run :
       std::span(stairs).first(std::min<std::size_t>(whole_runs, stairs.size()))) {
    whole.push_back(&run);
  }
  for (const char* name : {"robust", "reference", "paper"}) {
    const BayesFilterConfig config = BayesFilterConfig::named(name);
    const MeasurementModel model = fit(whole, config.measurement, {});
    fitted.make[name] = [=] { return std::make_unique<BayesFilter>(model, config); };
    if (std::string(name) == "robust") {
      fitted.make["measurement_only"] = [=] {
        return std::make_unique<MeasurementOnly>(model, config);
      };
    }
  }
  return fitted;
}

}  // namespace touchdown
