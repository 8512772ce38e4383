#include "experiments/experiment_context.hpp"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/machine.hpp"
#include "experiments/config/experiment_yaml.hpp"
#include "experiments/plan/plan.hpp"
#include "experiments/run_directory/directory.hpp"
#include "experiments/run_directory/own_files.hpp"
#include "experiments/studies/registry.hpp"

namespace touchdown::experiments {

namespace {

/// Errors: `Error` that names the settings to lower, if the plan and the signals of a fit's runs do
/// not fit into memory. It is known before the plan, which may be too large itself.
void require_memory(const RunRequest& request) {
  constexpr double planned_bytes = sizeof(PlannedRun) + 512.0;  // with terrain and scripts
  constexpr double step_bytes =
      sizeof(Signals) + static_cast<double>(models::wheel_count) * (sizeof(double) + 1.0);
  const Experiment& experiment = request.experiment;
  const auto engines = static_cast<double>(experiment.simulators.size());
  const double tested =
      engines * static_cast<double>(experiment.test.scenarios.size()) * experiment.test.runs;
  const double parts = tested * experiment.noise.seeds;
  double fitted_steps = 0.0;
  for (const std::string& file : experiment.fit.scenarios) {
    const scenarios::Scenario& scenario = scenario_of(request, file).scenario;
    fitted_steps += experiment.fit.runs * scenario.end.duration /
                    (1e-6 * static_cast<double>(scenario.simulation.steps.control_us));
  }
  const double held = step_bytes * fitted_steps;
  const double needed = tested * planned_bytes + parts * sizeof(Task) + held;
  const double memory = machine_share().memory;
  if (needed <= memory) return;
  throw Error(fmt::format(
      "{}: {:.0f} test runs, {:.0f} parts and fitted runs of {:.1f} GB (test.runs={}, fit.runs={}, "
      "noise.seeds={}) need at least {:.1f} GB of memory, and this process may use {:.1f} GB: "
      "lower {}",
      experiment.name, tested, parts, 1e-9 * held, experiment.test.runs, experiment.fit.runs,
      experiment.noise.seeds, 1e-9 * needed, 1e-9 * memory,
      held > 0.5 * needed ? "fit.runs" : "test.runs or noise.seeds"));
}

}  // namespace

Plan whole_plan(const RunRequest& request) {
  require_memory(request);
  Plan plan = plan_of(request);
  for (const Study* study : requested_studies(request.experiment)) study->plan(request, plan);
  keep_recordings(request.experiment, plan);
  require_distinct_runs(plan, request.experiment);
  return plan;
}

ExperimentContext start(RunRequest request, Plan plan, RunDirectory directory,
                        const RunOptions& options) {
  const int workers = request.experiment.workers;
  const int threads = workers > 0 ? workers : machine_share().processors;
  ShouldContinue should_continue = [stop = options.stop, directory] {
    directory.require_in_place();
    return stop == nullptr || !*stop;
  };
  request.experiment.intervals.bootstrap.before_resamples = [should_continue] {
    if (!should_continue()) throw Stopped();
  };
  return {std::move(request),
          std::move(directory),
          std::move(plan),
          std::move(should_continue),
          {options.command, threads, {}},
          tbb::global_control(tbb::global_control::max_allowed_parallelism,
                              static_cast<std::size_t>(threads))};
}

ExperimentContext reopened(const std::filesystem::path& path, const RunOptions& options) {
  require_no_links(path);
  std::optional<DirectoryLock> lock;
  if (owner_of(path)) lock.emplace(path, Access::alone, options.command);
  RunRequest request = read_request(path);  // throws if no run owns the directory
  RunDirectory directory(request.experiment.name, request.id, path);
  directory.keep(*lock);
  Plan plan = whole_plan(request);
  return start(std::move(request), std::move(plan), std::move(directory), options);
}

std::string what_is_saved(const ExperimentContext& context) {
  const std::vector<PlannedRun>& runs = context.plan.runs;
  const auto kept = std::ranges::count(runs, true, &PlannedRun::kept);
  const auto recordings = std::ranges::count_if(
      runs, [&](const PlannedRun& run) { return run.kept && has_stamp(run, context.directory); });
  const auto parts = std::ranges::count_if(context.plan.tasks, [&](const Task& task) {
    return saved_counts(context.plan, task, context.directory.store()).has_value();
  });
  return fmt::format(
      "stopped; {} of {} recordings and {} of {} parts of the evaluation are saved in {}; the "
      "same command continues from there",
      recordings, kept, parts, context.plan.tasks.size(), context.directory.path().string());
}

}  // namespace touchdown::experiments
