#include "experiments/fit_cost.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "core/error.hpp"
#include "experiments/config/experiment_estimators.hpp"
#include "experiments/processor_time.hpp"
#include "experiments/stages/process_memory.hpp"

namespace touchdown::experiments {

namespace {

constexpr double fitted_seconds = 3.0;  // of each

double seconds_of(const RunSignals& run) {
  return static_cast<double>(run.steps()) * period_of(run);
}

/// Processor time of a fitted estimator for one second of a run.
double update_seconds(const EstimatorEntry& entry, const Model& model, const RunSignals& run) {
  EstimatorRunner runner = runner_of(entry, {1.0 / period_of(run), &model, run.legs, &run.contact});
  double last = 0.0;  // the beliefs are needed, or the compiler leaves them out
  const double cost = cost_of([&] {
    runner.run_estimator(
        run, [&](std::size_t k) { return run.signals[k]; },
        [&](std::size_t /*k*/, const Belief& belief) { last += belief.wheel[0].p_contact; });
  });
  return std::isnan(last) ? 0.0 : cost / seconds_of(run);
}

/// Fits the model, and splits its cost. The training of a fit that draws a fixed number of rows
/// does not grow with the data; only its passes over the data do.
FitCost cost_of_fit(const EstimatorEntry& entry, const FitRuns& data, double seconds,
                    Model& model) {
  FitCost cost;
  cost.estimator = entry.name;
  cost.is_upper_bound = entry.is_upper_bound;
  cost.is_tuned = !entry.is_upper_bound &&
                  std::any_of(entry.hyperparameters.begin(), entry.hyperparameters.end(),
                              [](const Hyperparameter& one) { return one.is_fitted_with; });
  const double before = memory_in_use();
  reset_peak_memory();
  const double measured = cost_of([&] { model = fit_model(entry, data); });
  cost.memory = std::max(0.0, peak_memory() - before);
  if (entry.fit_passes == 0) {
    cost.per_second = measured / seconds;
    return cost;
  }
  cost.passes = entry.fit_passes;
  cost.fixed = measured;
  cost.per_second = update_seconds(entry, model, *data.whole.front());
  return cost;
}

/// Completes the costs of fits with passes over the data. A pass computes inputs without their
/// evaluation, so the cheapest estimator of this kind gives its cost.
void spread_passes(std::vector<FitCost>& costs, double seconds) {
  double cheapest = std::numeric_limits<double>::infinity();
  for (const FitCost& cost : costs) {
    if (cost.passes > 0) cheapest = std::min(cheapest, cost.per_second);
  }
  for (FitCost& cost : costs) {
    if (cost.passes == 0) continue;
    cost.per_second = cost.passes * cheapest;
    cost.fixed = std::max(0.0, cost.fixed - cost.per_second * seconds);
  }
}

}  // namespace

double FitSample::of(double seconds) const {
  double sum = 0.0;
  for (const FitCost& cost : costs) sum += cost.of(seconds);
  return sum;
}

double FitSample::of_refit(double seconds) const {
  double sum = 0.0;
  for (const FitCost& cost : costs) sum += cost.is_upper_bound ? 0.0 : cost.of(seconds);
  return sum;
}

double FitSample::memory(int at_once) const {
  std::vector<double> all;
  for (const FitCost& cost : costs) all.push_back(cost.memory);
  std::sort(all.begin(), all.end(), std::greater<>());
  all.resize(std::min(all.size(), static_cast<std::size_t>(at_once)));
  double sum = 0.0;
  for (const double one : all) sum += one;
  return sum;
}

RunSignals beginning_of(const RunSignals& run, double seconds) {
  RunSignals part = run;
  const auto steps = static_cast<std::size_t>(
      std::llround(1e6 * seconds / static_cast<double>(run.info.control_period_us)));
  if (steps >= run.steps()) return part;
  part.signals.resize(steps);
  part.up_in_imu.resize(steps);
  for (std::size_t w = 0; w < models::wheel_count; ++w) {
    part.contact[w].resize(steps);
    part.normal_force[w].resize(steps);
  }
  std::erase_if(part.segments, [&](std::size_t first) { return first >= steps; });
  part.motion.reset();
  return part;
}

FitSample sample_fits(const Experiment& experiment, const Rollouts& runs,
                      const ShouldContinue& should_continue) {
  FitSample found;
  const std::string& engine = experiment.simulators.front();
  std::vector<RunSignals> parts;
  double seconds = 0.0;
  for (const auto& [index, run] : runs) {
    const bool is_wanted = run.plan.role == RunRole::fit && run.plan.simulator == engine &&
                           run.plan.fit.empty() && !run.failed() && parts.size() < most_fitted_runs;
    if (!is_wanted) continue;
    parts.push_back(beginning_of(run.signals, fitted_seconds));
    seconds += seconds_of(parts.back());
  }
  if (parts.empty()) return found;
  const FitRuns data{pointers_to(parts),
                     {},
                     experiment.scoring,
                     [&] {
                       if (!should_continue()) throw Stopped();
                     },
                     experiment.fit_servo_load};
  std::map<std::string, FittedModel>& models = found.models[engine];
  for (const std::string& name : experiment.estimators) {
    const EstimatorEntry& entry = estimator_entry(experiment, name);
    if (!entry.fits()) continue;
    const auto same = std::find_if(models.begin(), models.end(), [&](const auto& other) {
      return share_model(entry, estimator_entry(experiment, other.first));
    });
    FittedModel model;
    if (same != models.end()) {
      model = same->second;
    } else {
      try {
        found.costs.push_back(cost_of_fit(entry, data, seconds, model));
      } catch (const InputError&) {
        found.unmeasured.push_back(name);  // the beginnings of the runs do not suffice for it
        continue;
      }
    }
    model.metadata = new_metadata(name, data, {});
    models[name] = std::move(model);
  }
  spread_passes(found.costs, seconds);
  return found;
}

}  // namespace touchdown::experiments
