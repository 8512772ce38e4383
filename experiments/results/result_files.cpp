#include "experiments/results/result_files.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/files.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/results/captions.hpp"
#include "experiments/results/evidence.hpp"
#include "experiments/results/paper.hpp"
#include "experiments/results/scores.hpp"
#include "experiments/results/summary_file.hpp"

namespace touchdown::experiments {

namespace {

void write_models(const FittedModels& models, const RunDirectory& directory) {
  for (const auto& [simulator, by_estimator] : models) {
    if (is_of_refit(simulator)) continue;
    for (const auto& [estimator, model] : by_estimator) {
      write_fitted_model(model, directory.file("models", model_name(simulator, estimator)));
    }
  }
}

Table runs_table(const std::vector<Rollout>& runs) {
  Table table{{"simulator", "scenario", "role", "run", "outcome", "flights", "duration_s"}, {}};
  for (const Rollout& run : runs) {
    table.rows.push_back(
        {run.plan.simulator, run.plan.scenario.name, std::string(to_text(run.plan.role)),
         std::to_string(run.plan.run),
         run.report.error.empty() ? std::string(recordings::to_text(run.report.outcome)) : "error",
         std::to_string(run.report.flights), metric(run.report.duration)});
  }
  return table;
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
  const Table evidence = evidence_table(result.models);
  if (!evidence.rows.empty()) result.directory.write_table("evidence.csv", evidence);
  result.directory.write_table("runs.csv", runs_table(result.runs));
  result.directory.write_table("success.csv", success_table(result.summaries));
  result.directory.write_table("classification.csv", classification_table(result.summaries));
  write_score_tables(result);
  write_summary(summary_of(result), result.directory.path());
}

}  // namespace touchdown::experiments
