#include "experiments/evaluation/tuning_table.hpp"

#include <iterator>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/files.hpp"
#include "core/fingerprint.hpp"
#include "core/table.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/plan/plan.hpp"
#include "simulators/registry.hpp"

namespace touchdown::experiments {

namespace {

/// The figure of `tuning.csv`: the score of every trial, with marks for the defaults and the chosen
/// values.
FigureSpec tuning_figure(const Table& tuning, const Experiment& experiment) {
  FigureSpec spec;
  spec.name = "tuning";
  spec.table = "tuning.csv";
  spec.panels = groups_in(tuning, "fit", [](const auto& name) { return name; });
  spec.series = groups_in(tuning, "simulator", simulators::simulator_title);
  spec.rows = groups_in(tuning, "estimator",
                        [&](const auto& name) { return estimator_entry(experiment, name).title; });
  spec.measures = {{.column = "event_f1", .title = "F1 of takeoffs and landings"}};
  spec.marks = {{MarkShape::points, {}},
                {MarkShape::cross, {{"trial", "0"}}},
                {MarkShape::ring, {{"chosen", "1"}}}};
  spec.title = "Hyperparameter trials";
  spec.caption = fmt::format(
      "A point per trial of an estimator's hyperparameters: F1 of takeoffs and landings, of the "
      "fitted runs in {}-fold cross-validation. A cross marks the defaults, a ring the chosen "
      "values (tables/tuning.csv).",
      experiment.tuning->folds);
  FigureSpec chosen = spec;
  chosen.where = {{"chosen", "1"}};
  spec.alt = "F1 of the chosen trials." + values_text(chosen, tuning);
  return spec;
}

/// "contact=12 low_pass=0.01".
std::string text_of(const HyperparameterValues& hyperparameters) {
  std::vector<std::string> all;
  for (const auto& [name, value] : hyperparameters) {
    all.push_back(fmt::format("{}={}", name, exact(value)));
  }
  return fmt::format("{}", fmt::join(all, " "));
}

/// Fits are named "_robot_sensors". The column omits the leading underscore.
std::string fit_text(const std::string& fit) { return fit.starts_with('_') ? fit.substr(1) : fit; }

void write_table(const std::vector<Trial>& trials, const RunDirectory& directory) {
  const auto columns = Columns<Trial>()
                           .text("simulator", &Trial::simulator)
                           .text("fit", [](const Trial& trial) { return fit_text(trial.fit); })
                           .text("estimator", &Trial::estimator)
                           .number("trial", &Trial::number)
                           .text("hyperparameters",
                                 [](const Trial& trial) { return text_of(trial.hyperparameters); })
                           .is(ColumnRole::note)
                           .metric("event_f1", &Trial::score)
                           .flag("chosen", &Trial::is_chosen);
  directory.write_table("tuning.csv", columns, trials);
}

/// The choices for the experiment's own fit, as its key `hyperparameters.tuned` takes them.
std::string chosen_yaml(const std::vector<Trial>& trials, const Experiment& experiment) {
  std::string text = fmt::format(
      "# Hyperparameters that fit.tuning chose: the best of {} trials in {}-fold "
      "cross-validation.\n"
      "manifest: {{experiment: {}, seed: {}, trials: {}, folds: {}, build: '{}'}}\n",
      experiment.tuning->trials, experiment.tuning->folds, experiment.name, seed_of_fit(experiment),
      experiment.tuning->trials, experiment.tuning->folds, build_commit());
  std::string simulator;
  for (const Trial& trial : trials) {
    if (!trial.is_chosen || !trial.fit.empty() || trial.hyperparameters.empty()) continue;
    if (trial.simulator != simulator) text += fmt::format("{}:\n", trial.simulator);
    simulator = trial.simulator;
    text += fmt::format("  {}:\n", trial.estimator);
    for (const auto& [name, value] : trial.hyperparameters) {
      text += fmt::format("    {}: {}\n", name, exact(value));
    }
  }
  return text;
}

std::string tuning_text(const std::vector<Trial>& trials, const Experiment& experiment) {
  TextTable table{{"", "on", "defaults", "chosen", "with"}, {}};
  const Trial* defaults = nullptr;
  for (const Trial& trial : trials) {
    if (trial.number == 0) defaults = &trial;
    if (!trial.is_chosen) continue;
    table.rows.push_back({estimator_entry(experiment, trial.estimator).title,
                          trial.simulator + trial.fit, fmt::format("{:.3f}", defaults->score),
                          fmt::format("{:.3f}", trial.score),
                          trial.number == 0 ? "its defaults" : text_of(trial.hyperparameters)});
  }
  return fmt::format(
      "Tuning: F1 of takeoffs and landings, of the fitted runs in {}-fold "
      "cross-validation; the best of {} trials\n{}",
      experiment.tuning->folds, experiment.tuning->trials, to_text(table, 2));
}

}  // namespace

TunedHyperparameters read_chosen(const std::filesystem::path& run_directory) {
  const std::filesystem::path file = run_directory / "tables" / "tuning.csv";
  if (!is_there(file)) return {};
  const TextTable table = from_csv(read_file(file));
  TunedHyperparameters chosen;
  for (const std::vector<std::string>& row : table.rows) {
    if (cell(table, row, "chosen") != "1" || !cell(table, row, "fit").empty()) continue;
    std::istringstream text(cell(table, row, "hyperparameters"));
    const std::vector<std::string> words(std::istream_iterator<std::string>(text), {});
    chosen[cell(table, row, "simulator")][cell(table, row, "estimator")] =
        hyperparameters_of(words);
  }
  return chosen;
}

StudyResult summarize_tuning(const std::vector<Trial>& trials, const Experiment& experiment,
                             const RunDirectory& directory) {
  write_table(trials, directory);
  write_atomically(directory.own_file("tables", "hyperparameters.yaml"),
                   chosen_yaml(trials, experiment));
  return {.texts = {tuning_text(trials, experiment)},
          .figures = {tuning_figure(directory.read_table("tuning.csv"), experiment)}};
}

}  // namespace touchdown::experiments
