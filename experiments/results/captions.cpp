#include "experiments/results/captions.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiments/estimators/registry.hpp"
#include "experiments/results/result.hpp"
#include "experiments/results/scores.hpp"
#include "simulators/registry.hpp"

namespace touchdown::experiments {

std::string plural(std::size_t count, const std::string& thing) {
  return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

std::string labels_text(const Experiment& experiment) {
  const scoring::LabelConfig& labels = experiment.labels;
  std::string text =
      fmt::format("contact: normal force > {:.3g} % of the weight, mean over {:.3g} ms",
                  1e2 * labels.share, 1e3 * labels.window);
  if (labels.annotator) {
    text += fmt::format(
        ", as annotated from pictures {:.3g} ms apart, takeoffs {:.3g} and landings {:.3g} ms late",
        1e3 * labels.annotator->frame, 1e3 * labels.annotator->takeoff_delay,
        1e3 * labels.annotator->landing_delay);
  }
  return text;
}

std::string sample_text(const Experiment& experiment) {
  return scoring::to_text(experiment.intervals.over);
}

std::string intervals_text(const Experiment& experiment) {
  return fmt::format("{:.0f} % bootstrap intervals over {}s",
                     100.0 * experiment.intervals.bootstrap.level, sample_text(experiment));
}

std::string tuning_text(const Experiment& experiment) {
  std::string given;
  for (const auto& [estimator, hyperparameters] : experiment.hyperparameters) {
    for (const auto& [name, value] : hyperparameters) {
      given += fmt::format("{}{} of {}: {}", given.empty() ? " Given: " : ", ", name,
                           estimator_title_in(experiment, estimator), exact(value));
    }
  }
  if (!experiment.engine_hyperparameters.empty()) {
    given += given.empty() ? " Given by engine (config.yaml)" : "; others by engine (config.yaml)";
  }
  if (!given.empty()) return given + '.';
  if (!experiment.tuning) return {};
  return fmt::format(
      " Each estimator with hyperparameters was tuned with {}, its defaults first, scored on {} "
      "folds "
      "of the fitted runs alone (tables/tuning.csv).",
      plural(static_cast<std::size_t>(experiment.tuning->trials), "trial"),
      experiment.tuning->folds);
}

std::string conditions_text(const Experiment& experiment) {
  return fmt::format("Both wheels; {}{}; first {} ms not scored; {}.{}", labels_text(experiment),
                     setup_caption(experiment), 1e3 * experiment.scoring.skip,
                     intervals_text(experiment), tuning_text(experiment));
}

std::string noise_text(const noise::NoiseCell& cell) {
  return fmt::format("torque noise {} N·m, accelerometer noise {} m/s²", cell.torque,
                     cell.accelerometer);
}

const EstimatorEntry* find_estimator(std::string_view name,
                                     std::span<const EstimatorEntry> external) {
  for (const auto entries : {external, estimator_entries()}) {
    for (const EstimatorEntry& entry : entries) {
      if (entry.name == name) return &entry;
    }
  }
  return nullptr;
}

std::string estimator_title(const std::string& estimator,
                            std::span<const EstimatorEntry> external) {
  const EstimatorEntry* const entry = find_estimator(estimator, external);
  return entry == nullptr ? estimator : entry->title;
}

std::string estimator_title_in(const Experiment& experiment, const std::string& estimator) {
  return estimator_title(estimator, experiment.external_estimators);
}

std::function<std::string(const std::string&)> titles_in(const Experiment& experiment) {
  return [&experiment](const std::string& name) { return estimator_title_in(experiment, name); };
}

bool is_fitted_to_test(const Experiment& experiment, const std::string& estimator) {
  const EstimatorEntry* const entry = find_estimator(estimator, experiment.external_estimators);
  const auto is_fitted_to = [&](const std::string& scene) {
    return std::ranges::find(experiment.fit.scenarios, scene) != experiment.fit.scenarios.end();
  };
  return entry != nullptr && entry->fits() &&
         std::ranges::any_of(experiment.test.scenarios, is_fitted_to);
}

std::string score_notes(const Experiment& experiment, const ScoreTables& tables) {
  std::vector<std::string> notes, silent, fitted;
  for (const std::string& name : experiment.estimators) {
    std::vector<std::string> settings;
    std::size_t all = 0;
    for (const noise::NoiseCell& highlight : experiment.highlights) {
      for (const TableRow& cell : tables.cells.all()) {
        if (cell.text("estimator") != name || !is_at(cell, highlight)) continue;
        ++all;
        if (!is_silent(cell)) continue;
        settings.push_back(fmt::format("{} in {}", noise_text(highlight),
                                       simulators::simulator_title(cell.text("simulator"))));
      }
    }
    const EstimatorEntry& entry = estimator_entry(experiment, name);
    if (!settings.empty() && entry.fits()) {
      silent.push_back(settings.size() == all
                           ? entry.title
                           : fmt::format("{} (at {})", entry.title, fmt::join(settings, "; at ")));
    }
    if (is_fitted_to_test(experiment, name)) fitted.push_back(entry.title);
  }
  int scored = 0;
  double flights = 0.0;
  std::array<double, 2> of_one_wheel{};  // of the fit and of the test
  for (const TableRow& run : tables.runs.all()) {
    const bool is_test = run.text("role") == to_text(RunRole::test);
    of_one_wheel.at(is_test ? 1 : 0) += run.number("wheel_flights");
    scored += is_test && is_scored(run) ? 1 : 0;
    flights += is_test ? run.number("flights") : 0.0;
  }
  if (scored > 0 && flights + of_one_wheel[1] == 0.0) {
    notes.emplace_back(
        "The test has no flight of a wheel: no takeoff can be missed, and to answer “contact” "
        "always is right.");
  }
  if (!fitted.empty()) {
    notes.push_back(fmt::format("Fitted to scenes of the test: {}.", fmt::join(fitted, ", ")));
  }
  const bool is_one = silent.size() == 1;
  if (!silent.empty()) {
    notes.push_back(fmt::format("{} hardly ever {} flight, so that {} as always contact does.",
                                fmt::join(silent, ", "), is_one ? "reports" : "report",
                                is_one ? "it decides" : "they decide"));
  }
  if (!silent.empty() && of_one_wheel[0] == 0.0 && of_one_wheel[1] > 0.0) {
    notes.push_back(fmt::format(
        "{} has no flight of one wheel alone, as the test has: add scenarios/push_off.yaml to "
        "fit.scenarios.",
        is_one ? "Its fit" : "Their fit"));
  }
  return fmt::format("{}", fmt::join(notes, " "));
}

TestRuns test_runs(const ExperimentResult& result, const std::string& simulator) {
  TestRuns runs;
  for (const FinishedRun& run : result.runs) {
    if (run.plan.role != RunRole::test || run.plan.simulator != simulator) continue;
    ++runs.all;
    if (!run.failed()) ++runs.scored;
  }
  return runs;
}

std::string text_of(const TestRuns& runs) {
  if (runs.scored == runs.all) return plural(runs.all, "test run");
  return fmt::format("{} of {}", runs.scored, plural(runs.all, "test run"));
}

std::string scored_text(const ExperimentResult& result, const std::string& simulator) {
  return fmt::format("{} × {}; {}{}", text_of(test_runs(result, simulator)),
                     plural(static_cast<std::size_t>(result.experiment.noise.seeds), "noise seed"),
                     labels_text(result.experiment), setup_caption(result.experiment));
}

}  // namespace touchdown::experiments
