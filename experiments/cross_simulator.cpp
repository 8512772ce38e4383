#include "experiments/cross_simulator.hpp"

#include <algorithm>
#include <chrono>
#include <thread>

#include <fmt/format.h>
#include <tbb/global_control.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "experiments/cross_simulator_tables.hpp"
#include "experiments/fingerprint.hpp"
#include "experiments/progress.hpp"
#include "experiments/run_request.hpp"

namespace touchdown {

namespace {

/// One check on its way through its phases.
class Check {
 public:
  Check(const CrossSimulator& config, const RunOptions& options)
      : config_(config),
        experiment_(config.experiment),
        options_(options),
        request_(request_of(config.experiment)),
        threads_(experiment_.workers > 0
                     ? experiment_.workers
                     : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()))),
        limit_(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads_)),
        variations_(plan_variations(config, request_.scenarios)),
        result_{
            config,
            Fingerprint().add(request_.id).add(to_yaml(config)).text(),
            RunDirectory(experiment_.name,
                         Fingerprint().add(request_.id).add(to_yaml(config)).text(), options.out),
            {},
            {},
            {},
            {},
            {},
            {options.command, threads_, {}}} {}

  CrossSimulatorResult run() {
    write_atomically(result_.directory.path() / "config.yaml", to_yaml(config_));
    timed("simulate", [&] { simulate(); });
    timed("fit", [&] { fit(); });
    timed("agreement", [&] { compare(); });
    timed("transfer", [&] { transfer(); });
    timed("sensitivity", [&] { vary(); });
    result_.verdicts =
        verdicts(result_.transfers, config_.verdict, experiment_.intervals.bootstrap.level);
    write_files(result_);
    return std::move(result_);
  }

 private:
  template <typename Phase>
  void timed(const char* name, const Phase& phase) {
    const auto start = std::chrono::steady_clock::now();
    phase();
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    result_.provenance.timings.emplace_back(name, elapsed.count());
  }

  bool going_on() const { return options_.stop == nullptr || !*options_.stop; }

  void simulate() {
    std::vector<PlannedRun> plan = plan_runs(experiment_, request_.scenarios);
    const std::size_t own = plan.size();
    for (const Variation& variation : variations_) {
      plan.insert(plan.end(), variation.plan.begin(), variation.plan.end());
    }
    Progress progress("simulating", "runs", static_cast<std::int64_t>(plan.size()));
    std::vector<PlayedRun> played = play_runs(
        experiment_, plan, result_.directory,
        [&] {
          progress.advance();
          return going_on();
        },
        [&] { return going_on(); });
    const auto middle = played.begin() + static_cast<std::ptrdiff_t>(own);
    varied_.assign(std::make_move_iterator(middle), std::make_move_iterator(played.end()));
    played.erase(middle, played.end());
    result_.runs = std::move(played);
  }

  void fit() {
    std::vector<HeardRun> fitted;
    for (const PlayedRun& run : result_.runs) {
      if (run.plan.role == RunRole::fit && !is_failure(run.report.outcome)) {
        fitted.push_back(run.heard);
      }
    }
    models_ = fit_models(experiment_, fitted);
  }

  std::vector<const PlayedRun*> test_runs(const std::string& simulator) const {
    std::vector<const PlayedRun*> runs;
    for (const PlayedRun& run : result_.runs) {
      if (run.plan.role == RunRole::test && run.plan.simulator == simulator) runs.push_back(&run);
    }
    return runs;
  }

  void compare() {
    const std::vector<const PlayedRun*> first = test_runs(experiment_.simulators[0]);
    const std::vector<const PlayedRun*> second = test_runs(experiment_.simulators[1]);
    std::vector<RunFacts> first_facts;
    std::vector<RunFacts> second_facts;
    for (std::size_t i = 0; i < first.size(); ++i) {
      if (is_failure(first[i]->report.outcome) || is_failure(second[i]->report.outcome)) continue;
      first_facts.push_back(facts_of(*first[i], experiment_));
      second_facts.push_back(facts_of(*second[i], experiment_));
    }
    if (first_facts.empty()) {
      throw Error("there is no test run that the robot gets through in both engines");
    }
    result_.agreement = agreement(first_facts, second_facts, experiment_.intervals.bootstrap);
  }

  void transfer() {
    const std::vector<NoiseCell>& cells = experiment_.highlights;
    const std::vector<Condition> conditions = transfer_conditions(experiment_);
    const std::vector<const HeardRun*> runs = scored_runs(result_.runs);
    Progress progress("transferring", "cells", sweep_size(experiment_, conditions, cells, runs));
    const auto counts =
        sweep(experiment_, conditions, cells, runs, models_, [&](std::int64_t done) {
          progress.advance(done);
          return going_on();
        });
    result_.transfers = transfers(counts, cells, experiment_.intervals.bootstrap);
  }

  void vary() {
    Progress progress("varying", "values", static_cast<std::int64_t>(variations_.size()));
    auto next = varied_.begin();
    for (const Variation& variation : variations_) {
      std::vector<const PlayedRun*> runs;
      for (std::size_t i = 0; i < variation.plan.size(); ++i) runs.push_back(&*next++);
      if (runs.empty()) {
        runs = test_runs(variation.simulator);
        runs.resize(static_cast<std::size_t>(config_.sensitivity_runs));
      }
      const auto rows = sensitivity(experiment_, variation, runs, models_,
                                    [&](std::int64_t /*cells*/) { return going_on(); });
      result_.sensitivities.insert(result_.sensitivities.end(), rows.begin(), rows.end());
      progress.advance();
    }
  }

  const CrossSimulator& config_;
  const Experiment& experiment_;
  const RunOptions& options_;
  RunRequest request_;
  int threads_;
  tbb::global_control limit_;
  std::vector<Variation> variations_;
  CrossSimulatorResult result_;
  std::vector<PlayedRun> varied_;
  FittedModels models_;
};

}  // namespace

CrossSimulatorResult run_cross_simulator(const CrossSimulator& config, const RunOptions& options) {
  return Check(config, options).run();
}

std::vector<std::string> failed_demands(const std::vector<Verdict>& verdicts) {
  std::vector<std::string> names;
  for (const Verdict& verdict : verdicts) {
    if (verdict.is_demanded && !verdict.holds) names.push_back(verdict.estimator);
  }
  return names;
}

}  // namespace touchdown
