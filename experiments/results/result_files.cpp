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
#include "recordings/model_file.hpp"

namespace touchdown::experiments {

namespace {

void write_models(const FittedModels& models, const RunDirectory& directory) {
  for (const auto& [key, by_estimator] : models) {
    for (const auto& [estimator, model] : by_estimator) {
      write_model_of(key, estimator, model, directory);
    }
  }
}

Columns<Rollout> run_columns() {
  return Columns<Rollout>()
      .text("simulator", [](const Rollout& run) { return run.plan.simulator; })
      .text("scenario", [](const Rollout& run) { return run.plan.scenario.name; })
      .text("role", [](const Rollout& run) { return to_text(run.plan.role); })
      .number("run", [](const Rollout& run) { return run.plan.run; })
      .text("outcome",
            [](const Rollout& run) {
              return run.report.error.empty() ? recordings::to_text(run.report.outcome) : "error";
            })
      .count("flights", [](const Rollout& run) { return run.report.flights; })
      .metric("duration_s", [](const Rollout& run) { return run.report.duration; });
}

void write_score_tables(const ExperimentResult& result) {
  const RunDirectory& directory = result.directory;
  directory.write_table("views.csv", views_columns(), result.scores);
  directory.write_table("transitions.csv", transitions_columns(), result.scores);
  directory.write_table("latency.csv", latency_columns(), result.scores);
  directory.write_table("calibration.csv", calibration_columns(), result.scores);
  directory.write_table("reliability.csv", reliability_columns(), reliability_bins(result.scores));
  directory.write_table("differences.csv", difference_columns(),
                        metric_differences(result.differences));
  if (!result.experiment.paper_tables) return;
  std::string markdown;
  std::string latex;
  for (const CaptionedTable& table : paper_tables(result)) {
    markdown += to_markdown(table) + "\n";
    latex += to_latex(table) + "\n";
  }
  write_atomically(directory.own_file("tables", "tables.md"), markdown);
  write_atomically(directory.own_file("tables", "tables.tex"), latex);
}

}  // namespace

void write_model_of(const std::string& key, const std::string& estimator, const Model& model,
                    const RunDirectory& directory) {
  if (is_of_refit(key) || !has_numbers(model)) return;
  recordings::save_model(model, directory.file("models", model_name(key, estimator)));
}

void write_result_files(const ExperimentResult& result) {
  write_models(result.models, result.directory);
  const RunDirectory& directory = result.directory;
  const std::vector<EvidencePoint> evidence = evidence_points(result.models);
  if (!evidence.empty()) directory.write_table("evidence.csv", evidence_columns().table(evidence));
  directory.write_table("runs.csv", run_columns().table(result.runs));
  directory.write_table("success.csv", success_columns(), result.summaries);
  directory.write_table("classification.csv", classification_columns(), result.summaries);
  write_score_tables(result);
  write_summary(summary_of(result), result.directory.path());
}

}  // namespace touchdown::experiments
