#include "experiments/execution.hpp"

#include <algorithm>
#include <chrono>
#include <set>
#include <thread>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "core/error.hpp"
#include "experiments/progress.hpp"
#include "experiments/result_files.hpp"
#include "experiments/saved_state.hpp"
#include "experiments/shard_log.hpp"
#include "experiments/stopped.hpp"

namespace touchdown {

namespace {

/// Adds the time since its construction to the provenance.
class PhaseTimer {
 public:
  PhaseTimer(Provenance& provenance, std::string phase)
      : provenance_(provenance), phase_(std::move(phase)) {}
  ~PhaseTimer() {
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
    provenance_.timings.emplace_back(phase_, elapsed.count());
  }
  PhaseTimer(const PhaseTimer&) = delete;
  PhaseTimer& operator=(const PhaseTimer&) = delete;

 private:
  Provenance& provenance_;
  std::string phase_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

std::vector<HeardRun> heard(const std::vector<PlayedRun>& runs, RunRole role) {
  std::vector<HeardRun> result;
  for (const PlayedRun& run : runs) {
    if (run.plan.role == role && !is_failure(run.report.outcome)) result.push_back(run.heard);
  }
  return result;
}

int threads_of(const Experiment& experiment) {
  if (experiment.workers > 0) return experiment.workers;
  return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

}  // namespace

Execution::Execution(RunRequest request, RunDirectory directory, const RunOptions& options)
    : request_(std::move(request)),
      directory_(std::move(directory)),
      stop_(options.stop),
      threads_(threads_of(request_.experiment)),
      limit_(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads_)),
      cells_(noise_cells(request_.experiment.noise)),
      plan_(plan_runs(request_.experiment, request_.scenarios)),
      tasks_(listening_tasks(request_.experiment, plan_)),
      saved_(directory_.path() / "state" / "listening", state_key(request_)) {}

std::size_t Execution::compute(std::size_t begin, std::size_t end) {
  try {
    simulate(begin, end, MissingRun::simulate);
    fit();
    return listen_to(begin, end);
  } catch (const Stopped&) {
    throw Stopped(what_is_saved());
  }
}

ExperimentResult Execution::assemble(const std::string& command) {
  if (runs_.size() != plan_.size()) {
    simulate(0, tasks_.size(), MissingRun::refuse);
    fit();
  }
  if (scored_runs(runs_).empty()) {
    throw Error("no test run stayed upright: there is nothing to score");
  }
  const Experiment& experiment = request_.experiment;
  const BootstrapConfig& config = experiment.intervals.bootstrap;
  ExperimentResult result{
      experiment, request_.id, directory_, std::move(runs_),       std::move(models_), cells_,
      {},         {},          {},         {command, threads_, {}}};
  {
    const PhaseTimer timer(provenance_, "score");
    const CollectedListening heard = collect(experiment, cells_, plan_, tasks_, saved_);
    result.summaries = summarise(heard.counts, cells_, config);
    for (std::size_t i = 0; i < experiment.highlights.size(); ++i) {
      const NoiseCell& cell = experiment.highlights[i];
      const auto scores = summarise(heard.highlights[i], cell, config);
      const auto compared = differences(heard.highlights[i], cell, config);
      result.scores.insert(result.scores.end(), scores.begin(), scores.end());
      result.differences.insert(result.differences.end(), compared.begin(), compared.end());
    }
  }
  result.provenance.timings = provenance_.timings;
  write_result_files(result);
  remove_shard_notes(directory_.path());
  remove_partial_files(directory_.path());
  write_manifest(result);
  return result;
}

std::vector<std::size_t> Execution::missing_tasks() const {
  std::set<std::size_t> missing_runs;
  bool fit_is_missing = false;
  for (std::size_t i = 0; i < plan_.size(); ++i) {
    if (is_recorded(request_.experiment, plan_[i], directory_)) continue;
    missing_runs.insert(i);
    fit_is_missing = fit_is_missing || plan_[i].role == RunRole::fit;
  }
  std::vector<std::size_t> missing;
  for (std::size_t t = 0; t < tasks_.size(); ++t) {
    const ListeningTask& task = tasks_[t];
    if (fit_is_missing || missing_runs.contains(task.run) ||
        !saved_.read(SavedListening::name(plan_[task.run], task.seed))) {
      missing.push_back(t);
    }
  }
  return missing;
}

/// Plays or reads the runs that the tasks from `begin` to `end` listen to, and those that their
/// estimators are fitted to.
void Execution::simulate(std::size_t begin, std::size_t end, MissingRun missing) {
  std::set<std::size_t> heard;
  std::set<std::string> simulators;
  for (std::size_t t = begin; t < end; ++t) {
    heard.insert(tasks_[t].run);
    simulators.insert(plan_[tasks_[t].run].simulator);
  }
  std::vector<PlannedRun> needed;
  run_of_.assign(plan_.size(), std::nullopt);
  for (std::size_t i = 0; i < plan_.size(); ++i) {
    const bool is_needed =
        plan_[i].role == RunRole::fit ? simulators.contains(plan_[i].simulator) : heard.contains(i);
    if (!is_needed) continue;
    run_of_[i] = needed.size();
    needed.push_back(plan_[i]);
  }
  const PhaseTimer timer(provenance_, "simulate");
  Progress progress("simulating", "runs", static_cast<std::int64_t>(needed.size()));
  runs_ = play_runs(
      request_.experiment, needed, directory_,
      [&] {
        progress.advance();
        return going_on();
      },
      [&] { return going_on(); }, missing);
}

void Execution::fit() {
  if (scored_runs(runs_).empty()) return;
  // A shard may have runs of one engine only.
  Experiment experiment = request_.experiment;
  std::erase_if(experiment.simulators, [&](const std::string& simulator) {
    return std::none_of(runs_.begin(), runs_.end(),
                        [&](const PlayedRun& run) { return run.plan.simulator == simulator; });
  });
  const PhaseTimer timer(provenance_, "fit");
  models_ =
      fit_models(experiment, touchdown::heard(runs_, RunRole::fit), [&] { return going_on(); });
  if (!going_on()) throw Stopped();
}

std::size_t Execution::listen_to(std::size_t begin, std::size_t end) {
  const PhaseTimer timer(provenance_, "listen");
  Progress progress("listening", "parts", static_cast<std::int64_t>(end - begin));
  std::atomic<std::size_t> computed = 0;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(begin, end, 1), [&](const auto& range) {
    for (std::size_t t = range.begin(); t < range.end(); ++t) {
      if (!going_on()) throw Stopped();
      if (listen_to(tasks_[t])) {
        ++computed;
        progress.advance();
      } else {
        progress.skip();
      }
    }
  });
  return computed;
}

/// Whether there was anything left to compute.
bool Execution::listen_to(const ListeningTask& task) {
  const std::string name = SavedListening::name(plan_[task.run], task.seed);
  if (saved_.read(name)) return false;
  const PlayedRun& run = runs_[*run_of_[task.run]];
  Heard heard;
  if (!is_failure(run.report.outcome)) {
    heard = listen(request_.experiment, cells_, run.heard, task.seed, models_,
                   [&] { return going_on(); });
  }
  saved_.write(name, heard);
  return true;
}

std::string Execution::what_is_saved() const {
  std::size_t recordings = 0;
  for (const PlannedRun& run : plan_) {
    recordings += has_stamp(request_.experiment, run, directory_) ? 1U : 0U;
  }
  std::size_t parts = 0;
  for (const ListeningTask& task : tasks_) {
    parts += saved_.read(SavedListening::name(plan_[task.run], task.seed)) ? 1U : 0U;
  }
  return fmt::format(
      "stopped; {} of {} recordings and {} of {} parts of the listening are saved in {}; the "
      "same command goes on from there",
      recordings, plan_.size(), parts, tasks_.size(), directory_.path().string());
}

}  // namespace touchdown
