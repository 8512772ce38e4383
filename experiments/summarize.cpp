#include <map>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/fingerprint.hpp"
#include "core/program.hpp"
#include "experiments/evaluation/tuning_table.hpp"
#include "experiments/results/long_table.hpp"
#include "experiments/results/result_files.hpp"
#include "experiments/results/samples.hpp"
#include "experiments/run_directory/own_files.hpp"
#include "experiments/run_directory/test_seed_log.hpp"
#include "experiments/signals/reserved_seeds.hpp"
#include "experiments/stages.hpp"
#include "experiments/studies/registry.hpp"

namespace touchdown::experiments {

void require_scored_run(const FinishedRuns& runs) {
  if (is_any_scored(runs)) return;
  std::map<std::string, std::string> endings;
  for (const auto& [index, run] : runs) {
    if (run.plan.role == RunRole::test) endings[run.plan.file] = run.report.ending;
  }
  throw Error("no test run stayed upright: there is nothing to score: " + failures_text(endings));
}

ExperimentResult score(ExperimentContext& context, Computed& done) {
  const Experiment& experiment = context.request.experiment;
  const Plan& plan = context.plan;
  ExperimentResult result{.experiment = experiment,
                          .id = context.request.id,
                          .inputs = context.request.inputs,
                          .directory = context.directory};
  result.models = std::move(done.models);
  result.cells = plan.groups.front().counted;
  const auto add = [&](const StudyResult& found) {
    const auto append = [](auto& all, const auto& more) {
      all.insert(all.end(), more.begin(), more.end());
    };
    append(result.studies, found.texts);
    append(result.failed_demands, found.failed_demands);
    append(result.figures, found.figures);
  };
  const StageTimer timer(context, "score");
  const ScoreRows own = score_rows(plan.runs_in(0), plan, context.directory.store());
  write_samples(own.counted, context.directory);
  result.tables = score_tables(own, experiment.intervals.bootstrap);
  if (experiment.tuning) {
    add(summarize_tuning(done.trials, experiment, context.directory));
  }
  const Evaluation evaluation{context.request,           plan, done.runs,
                              context.directory.store(), own,  result.models};
  for (const Study* study : requested_studies(experiment)) {
    add(study->summarize(evaluation, context.directory));
  }
  return result;
}

void log_reserved_seed(ExperimentResult& result) {
  const std::uint64_t seed = result.experiment.seed;
  if (!is_reserved(seed)) return;
  const std::filesystem::path log = test_seed_log();
  const int others = log_evaluation(log, {seed, result.id, build_commit()});
  result.studies.push_back(fmt::format(
      "Seed {} is reserved for numbers that are reported once: other configurations or builds "
      "scored its runs {} times before ({})\n",
      seed, others, log.string()));
}

void write_result(const ExperimentContext& context, Computed& done, ExperimentResult& result) {
  for (auto& [index, run] : done.runs) {
    if (run.plan.group == 0) result.runs.push_back(std::move(run));
  }
  result.tables.runs = runs_table(result.runs);
  release_free_memory();  // of the studies' tables
  result.provenance = context.provenance;
  write_result_files(result);
  write_results(context.request, context.directory);
  remove_partial_files(context.directory.path());
  write_manifest(result);
}

}  // namespace touchdown::experiments
