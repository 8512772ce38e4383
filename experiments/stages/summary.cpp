#include "experiments/stages/summary.hpp"

#include <map>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/fingerprint.hpp"
#include "core/program/memory.hpp"
#include "experiments/results/manifest.hpp"
#include "experiments/results/result_files.hpp"
#include "experiments/rollouts/failures.hpp"
#include "experiments/run_directory/own_files.hpp"
#include "experiments/run_directory/test_seed_log.hpp"
#include "experiments/signals/reserved_seeds.hpp"
#include "experiments/studies/registry.hpp"
#include "experiments/tables/results.hpp"
#include "experiments/tuning/table.hpp"

namespace touchdown::experiments {

namespace {

/// Errors: `Error` with the reasons if no test run can be scored.
void require_scored_run(const Rollouts& runs) {
  if (is_any_scored(runs)) return;
  std::map<std::string, std::string> endings;
  for (const auto& [index, run] : runs) {
    if (run.plan.role == RunRole::test) endings[run.plan.file] = run.report.ending;
  }
  throw Error("no test run stayed upright: there is nothing to score: " + failures_text(endings));
}

/// Scores with intervals, and the studies. Errors: `Stopped`.
ExperimentResult score(ExperimentContext& context, Computed& done) {
  const Experiment& experiment = context.request.experiment;
  const Plan& plan = context.plan;
  ExperimentResult result{
      experiment, context.request.id, context.directory, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}};
  result.models = std::move(done.fitted.models);
  result.cells = plan.groups.front().counted;
  const auto add = [&](const StudyResult& found) {
    const auto append = [](auto& all, const auto& more) {
      all.insert(all.end(), more.begin(), more.end());
    };
    append(result.studies, found.texts);
    append(result.failed_demands, found.failed_demands);
    append(result.figures, found.figures);
  };
  timed(context, "score", [&] {
    require_scored_run(done.runs);
    const CollectedCounts counts = collect(plan, plan.runs_in(0), context.saved);
    const scoring::BootstrapConfig& bootstrap = experiment.intervals.bootstrap;
    result.summaries = summarise(own(counts.counted), result.cells, bootstrap);
    const std::vector<ConditionScores> scored = own(counts.scored);
    result.scores = summarise(scored, experiment.highlights, bootstrap);
    result.differences = differences(scored, experiment.highlights, bootstrap);
    if (experiment.tuning) {
      add(summarize_tuning(done.fitted.trials, experiment, context.directory));
    }
    const Evaluation evaluation{
        context.request,          plan, done.runs, context.saved, counts, result.models,
        context.saved_model_tasks};
    for (const Study* study : requested_studies(experiment)) {
      add(study->summarize(evaluation, context.directory));
    }
    return 0;
  });
  return result;
}

}  // namespace

ExperimentResult summarize(ExperimentContext& context, Computed done) {
  const Experiment& experiment = context.request.experiment;
  ExperimentResult result = [&] {
    try {
      return score(context, done);
    } catch (const Stopped&) {
      throw Stopped(what_is_saved(context));
    }
  }();
  if (is_reserved(experiment.seed)) {
    const std::filesystem::path log = test_seed_log();
    const int others = log_evaluation(log, {experiment.seed, result.id, build_commit()});
    result.studies.push_back(fmt::format(
        "Seed {} is reserved for numbers that are reported once: other configurations or builds "
        "scored its runs {} times before ({})\n",
        experiment.seed, others, log.string()));
  }
  for (auto& [index, run] : done.runs) {
    if (run.plan.group == 0) result.runs.push_back(std::move(run));
  }
  release_free_memory();  // of the studies' tables
  result.provenance = context.provenance;
  write_result_files(result);
  write_results(context.request, context.directory);
  remove_shard_marks(context.directory.path());
  remove_partial_files(context.directory.path());
  write_manifest(result);
  return result;
}

}  // namespace touchdown::experiments
