#include "experiments/tables/result_files.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/files.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/tables/captions.hpp"
#include "experiments/tables/label_sensitivity.hpp"
#include "experiments/tables/paper.hpp"
#include "experiments/tables/scores.hpp"
#include "experiments/tables/summary_file.hpp"

namespace touchdown::experiments {

namespace {

void write_models(const FittedModels& models, const RunDirectory& directory) {
  for (const auto& [simulator, by_estimator] : models) {
    for (const auto& [estimator, model] : by_estimator) {
      write_fitted_model(model, directory.file("models", model_name(simulator, estimator)));
    }
  }
}

Table runs_table(const std::vector<PlayedRun>& runs) {
  Table table{{"simulator", "scenario", "role", "run", "outcome", "flights", "duration_s"}, {}};
  for (const PlayedRun& run : runs) {
    table.rows.push_back(
        {run.plan.simulator, run.plan.scenario.name, std::string(to_text(run.plan.role)),
         std::to_string(run.plan.run),
         run.report.error.empty() ? std::string(recordings::to_text(run.report.outcome)) : "error",
         std::to_string(run.report.flights), metric(run.report.duration)});
  }
  return table;
}

/// What the numbers of one cell are, in words.
std::string how_scored(const Experiment& experiment, const noise::NoiseCell& cell) {
  return fmt::format("Both wheels; {}, {} noise seeds; {}; {}.", noise_text(cell),
                     experiment.noise.seeds, labels_text(experiment), intervals_text(experiment));
}

template <typename Row>
std::vector<Row> in_cell(std::vector<Row> rows, const noise::NoiseCell& cell) {
  std::erase_if(rows, [&](const Row& row) { return !(row.cell == cell); });
  return rows;
}

/// The paper's tables for every highlighted cell, one below the other.
std::vector<CaptionedTable> paper_tables(const ExperimentResult& result) {
  std::vector<CaptionedTable> tables;
  for (const noise::NoiseCell& cell : result.experiment.highlights) {
    for (CaptionedTable& table :
         paper_tables(in_cell(result.scores, cell), how_scored(result.experiment, cell))) {
      tables.push_back(std::move(table));
    }
    tables.push_back(difference_text_table(in_cell(result.differences, cell)));
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
  write_summary(summary_of(result), result.directory.path());
}

std::string summary_text(const ExperimentResult& result) {
  const Experiment& experiment = result.experiment;
  std::string text;
  for (const std::string& simulator : experiment.simulators) {
    const auto runs = scored_runs(result.runs);
    const auto scored = std::count_if(runs.begin(), runs.end(), [&](const RunSignals* run) {
      return run->info.simulator == simulator;
    });
    for (const noise::NoiseCell& cell : experiment.highlights) {
      text += fmt::format("\n{}: {} test runs × {} noise seeds, {}\n\n", simulator, scored,
                          experiment.noise.seeds, noise_text(cell));
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
  for (const std::string& study : result.studies) text += '\n' + study;
  text += fmt::format("\n{}\n", conditions_text(experiment));
  for (const PlayedRun& run : result.runs) {
    if (!run.failed()) continue;
    text += run.report.error.empty()
                ? fmt::format("Not used: {} ({} after {:.1f} s)\n", run.plan.file,
                              recordings::to_text(run.report.outcome), run.report.duration)
                : fmt::format("Not used: {} (could not be simulated: {})\n", run.plan.file,
                              run.report.error);
  }
  return text;
}

}  // namespace touchdown::experiments
