#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/program.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/stages.hpp"

namespace touchdown::experiments {

Computed::Computed(const Plan& plan, const TaskRange& of_plan, MissingRun if_missing)
    : share(of_plan), missing(if_missing), pending(plan, of_plan) {
  std::set<std::size_t> needed = runs_for(plan, share);
  if (has_model_tasks(plan, share)) {
    for (std::size_t i = 0; i < plan.runs.size(); ++i) {
      if (plan.runs[i].role == RunRole::fit && plan.runs[i].fit.empty()) needed.insert(i);
    }
  }
  for (const std::size_t index : needed) {
    (is_streamed(plan.runs[index], plan) ? streamed : held).insert(index);
  }
}

StageTimer::~StageTimer() {
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
  auto& timings = context_.provenance.timings;
  auto same = std::ranges::find(timings, stage_, &std::pair<std::string, double>::first);
  if (same == timings.end()) same = timings.insert(same, {stage_, 0.0});
  same->second += elapsed.count();
}

void simulate(ExperimentContext& context, Computed& done) {
  const StageTimer timer(context, "simulate");
  done.runs = hold_rollouts(context, done.held, done.missing);
}

void drop_signals(Rollout& run) {
  RunSignals left;
  left.info = std::move(run.signals.info);
  run.signals = std::move(left);
}

Rollouts hold_rollouts(const ExperimentContext& context, const std::set<std::size_t>& wanted,
                       MissingRun missing) {
  const Experiment& experiment = context.request.experiment;
  Rollouts runs;
  for (const std::size_t index : wanted) {
    runs.emplace(index, Rollout{context.plan.runs[index], {}, {}});
  }
  FitRunCheck check(experiment, context.plan, wanted);
  for_each_rollout(experiment, context.plan, wanted, context.directory, missing,
                   context.should_continue, [&](std::size_t index, Rollout run) {
                     check.add(run);
                     runs.at(index) = std::move(run);
                   });
  return runs;
}

FitRunCheck::FitRunCheck(const Experiment& experiment, const Plan& plan,
                         const std::set<std::size_t>& needed) {
  for (const std::string& name : experiment.estimators) {
    if (estimator_entry(experiment, name).fits()) fitted_estimators_.push_back(name);
  }
  for (const std::size_t index : needed) {
    const PlannedRun& run = plan.runs[index];
    if (run.role == RunRole::fit) ++fits_[{run.fit, run.simulator}].left;
  }
}

void FitRunCheck::add(const Rollout& run) {
  if (run.plan.role != RunRole::fit) return;
  std::array<bool, 3> own = {};
  if (!run.failed()) {
    const auto& [left, right] = run.signals.contact;
    for (std::size_t k = 0; k < left.size(); ++k) {
      own.at(static_cast<std::size_t>(left[k] + right[k])) = true;
    }
  }
  const std::lock_guard lock(mutex_);
  Runs& runs = fits_.at({run.plan.fit, run.plan.simulator});
  runs.scenes.insert(run.plan.scenario.name);
  runs.is_any_usable = runs.is_any_usable || !run.failed();
  if (run.failed()) runs.failures[run.plan.file] = run.report.ending;
  for (std::size_t wheels = 0; wheels < own.size(); ++wheels) {
    runs.has_contact[wheels] = runs.has_contact[wheels] || own[wheels];
  }
  if (--runs.left > 0) return;
  const std::string& simulator = run.plan.simulator;
  if (!runs.is_any_usable) {
    if (fitted_estimators_.empty()) return;
    throw InputError(fmt::format("fit on {}: {}: no run of fit.scenarios stayed upright: {}",
                                 simulator, fmt::join(fitted_estimators_, ", "),
                                 failures_text(runs.failures)));
  }
  const auto require = [&](bool holds, const char* missing) {
    if (holds || fitted_estimators_.empty()) return;
    throw InputError(fmt::format("fit on {}: {}: fit.scenarios contain no {}: {}", simulator,
                                 fmt::join(fitted_estimators_, ", "), missing,
                                 fmt::join(runs.scenes, ", ")));
  };
  const auto [flight, one_wheel, rolling] = runs.has_contact;
  require(rolling || one_wheel, "contact");
  require(flight || one_wheel, "step without contact");
}

}  // namespace touchdown::experiments
