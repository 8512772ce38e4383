#include "experiments/result_files.hpp"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "core/files.hpp"
#include "experiments/estimator_registry.hpp"
#include "experiments/label_sensitivity.hpp"
#include "experiments/paper_tables.hpp"
#include "experiments/score_tables.hpp"
#include "recordings/model_file.hpp"

namespace touchdown {

namespace {

void write_models(const FittedModels& models, const RunDirectory& directory) {
  for (const auto& [simulator, by_estimator] : models) {
    for (const auto& [estimator, model] : by_estimator) {
      const auto file = directory.file("models", fmt::format("{}_{}.npz", simulator, estimator));
      if (model.measurement) write_measurement_model(*model.measurement, file);
      if (model.phase) write_phase_model(*model.phase, file);
    }
  }
}

Table runs_table(const std::vector<PlayedRun>& runs) {
  Table table{{"simulator", "scenario", "role", "run", "outcome", "flights", "duration_s"}, {}};
  for (const PlayedRun& run : runs) {
    table.rows.push_back(
        {run.plan.simulator, run.plan.scenario.name, run.plan.role == RunRole::fit ? "fit" : "test",
         std::to_string(run.plan.run),
         run.report.error.empty() ? std::string(to_text(run.report.outcome)) : "error",
         std::to_string(run.report.flights), metric(run.report.duration)});
  }
  return table;
}

/// What the numbers of one cell are, in words.
std::string how_scored(const Experiment& experiment, const NoiseCell& cell) {
  return fmt::format(
      "Both wheels; torque noise {} N·m, accelerometer noise {} m/s², {} noise seeds; contact: "
      "normal force > {} N, states under {} ms merged; {:.0f} % bootstrap intervals over {}s.",
      cell.torque, cell.accelerometer, experiment.noise.seeds, experiment.labels.force_threshold,
      1e3 * experiment.labels.debounce, 100.0 * experiment.intervals.bootstrap.level,
      experiment.intervals.over == SampleUnit::run ? "run" : "drop");
}

/// The paper's tables for every highlighted cell, one below the other.
std::vector<CaptionedTable> paper_tables(const ExperimentResult& result) {
  std::vector<CaptionedTable> tables;
  for (const NoiseCell& cell : result.experiment.highlights) {
    std::vector<ScoreSummary> scores;
    std::copy_if(result.scores.begin(), result.scores.end(), std::back_inserter(scores),
                 [&](const ScoreSummary& score) { return score.cell == cell; });
    std::vector<Difference> compared;
    std::copy_if(result.differences.begin(), result.differences.end(), std::back_inserter(compared),
                 [&](const Difference& difference) { return difference.cell == cell; });
    for (CaptionedTable& table : paper_tables(scores, how_scored(result.experiment, cell))) {
      tables.push_back(std::move(table));
    }
    tables.push_back(difference_text_table(compared));
  }
  return tables;
}

void write_score_tables(const ExperimentResult& result) {
  const RunDirectory& directory = result.directory;
  directory.write_table("views.csv", views_table(result.scores));
  directory.write_table("transitions.csv", transitions_table(result.scores));
  directory.write_table("latency.csv", latency_table(result.scores));
  directory.write_table("calibration.csv", calibration_table(result.scores));
  directory.write_table("reliability.csv", reliability_table(result.scores));
  directory.write_table("differences.csv", differences_table(result.differences));
  if (!result.experiment.paper_tables) return;
  const Table labels = label_sensitivity_table(result);
  directory.write_table("labels.csv", labels);
  write_atomically(
      directory.file("tables", "labels.md"),
      to_markdown({"Point-wise scores by the definition of contact.", "labels", labels}));
  std::string markdown;
  std::string latex;
  for (const CaptionedTable& table : paper_tables(result)) {
    markdown += to_markdown(table) + "\n";
    latex += to_latex(table) + "\n";
  }
  write_atomically(directory.file("tables", "tables.md"), markdown);
  write_atomically(directory.file("tables", "tables.tex"), latex);
}

}  // namespace

void write_result_files(const ExperimentResult& result) {
  write_models(result.models, result.directory);
  result.directory.write_table("runs.csv", runs_table(result.runs));
  result.directory.write_table("success.csv", success_table(result.summaries));
  result.directory.write_table("classification.csv", classification_table(result.summaries));
  write_score_tables(result);
}

std::string summary_text(const ExperimentResult& result) {
  const Experiment& experiment = result.experiment;
  std::string text;
  for (const std::string& simulator : experiment.simulators) {
    int scored = 0;
    for (const HeardRun* run : scored_runs(result.runs)) {
      scored += run->info.simulator == simulator ? 1 : 0;
    }
    for (const NoiseCell& cell : experiment.highlights) {
      text += fmt::format(
          "\n{}: {} test runs × {} noise seeds, torque noise {} N·m, "
          "accelerometer noise {} m/s²\n\n",
          simulator, scored, experiment.noise.seeds, cell.torque, cell.accelerometer);
      text += to_text(cell_text_table(result.summaries, simulator, cell));
    }
    if (result.cells.size() > 1) {
      const std::string& first = experiment.estimators.front();
      text += fmt::format(
          "\n{}: success rate of {} by torque and accelerometer noise "
          "(* no better than always contact)\n\n",
          simulator, estimator_entry(first).title);
      text += to_text(grid_text_table(result.summaries, simulator, first, experiment.noise));
    }
  }
  if (experiment.paper_tables) {
    for (const CaptionedTable& table : paper_tables(result)) text += '\n' + to_text(table);
  }
  text += fmt::format(
      "\nBoth wheels; contact: normal force > {} N, states under {} ms merged; first {} ms not "
      "scored; {:.0f} % bootstrap intervals over {}s.\n",
      experiment.labels.force_threshold, 1e3 * experiment.labels.debounce,
      1e3 * experiment.scoring.skip, 100.0 * experiment.intervals.bootstrap.level,
      experiment.intervals.over == SampleUnit::run ? "run" : "drop");
  for (const PlayedRun& run : result.runs) {
    if (!is_failure(run.report.outcome)) continue;
    text += run.report.error.empty()
                ? fmt::format("Not used: {} ({} after {:.1f} s)\n", run.plan.file,
                              to_text(run.report.outcome), run.report.duration)
                : fmt::format("Not used: {} (could not be simulated: {})\n", run.plan.file,
                              run.report.error);
  }
  return text;
}

}  // namespace touchdown
