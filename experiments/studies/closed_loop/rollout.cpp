#include "experiments/studies/closed_loop/rollout.hpp"

#include <cstring>
#include <new>
#include <type_traits>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "core/error.hpp"
#include "core/progress.hpp"
#include "experiments/fitting/make_estimator.hpp"
#include "experiments/plan/condition.hpp"
#include "experiments/plan/sensors.hpp"
#include "experiments/run_directory/saved_state.hpp"
#include "experiments/signals/motion.hpp"
#include "scenarios/engine.hpp"
#include "scenarios/leg_geometry.hpp"
#include "scenarios/policy_contact.hpp"

namespace touchdown::experiments {

namespace {

/// The estimator with the model that was fitted in this engine.
std::unique_ptr<ContactEstimator> estimator_of(const Experiment& experiment,
                                               const ClosedLoopCell& cell,
                                               const FittedModels& models, double period,
                                               const LegGeometry& legs) {
  const EstimatorEntry entry =
      entry_of(experiment, {cell.simulator, cell.simulator, cell.contact}, models);
  const FittedModel* model =
      entry.fits() ? &models.at(model_key(cell.simulator, {})).at(entry.name) : nullptr;
  return entry.make(entry, {.sample_rate = 1.0 / period, .model = model, .legs = legs});
}

ClosedLoopMetrics rollout(const RunRequest& request, const ClosedLoopCell& cell, std::int64_t run,
                          const FittedModels& models, scenarios::CompiledScenes& scenes,
                          const ShouldContinue& should_continue) {
  const Experiment& experiment = request.experiment;
  try {
    const ClosedLoopRun loop = run_closed_loop(request, cell, run, models, scenes, should_continue);
    return closed_loop_metrics_of(loop.recording, loop.trace.contact,
                                  wheeled_biped(*scenes.as_described(loop.scenario)),
                                  experiment.labels, experiment.scoring);
  } catch (const InputError&) {
    throw;
  } catch (const Stopped&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;  // no failure of the run
  } catch (const std::exception&) {
    return {.runs = 1, .fell = 1};
  }
}

std::string name_of(std::size_t run) { return fmt::format("run_{:06}", run); }

}  // namespace

ClosedLoopRun run_closed_loop(const RunRequest& request, const ClosedLoopCell& cell,
                              std::int64_t run, const FittedModels& models,
                              scenarios::CompiledScenes& scenes,
                              const ShouldContinue& should_continue) {
  const Experiment& experiment = request.experiment;
  scenarios::Scenario scenario = scenario_of(request, cell);
  if (experiment.test.perturbed) scenario = scenarios::perturbed(scenario, experiment.seed, run);
  const auto simulator = scenarios::make_simulator(scenario, cell.simulator, scenes.of(scenario));
  const double period = simulator->control_period();
  ClosedLoopRun loop;
  policies::WheelContact source;
  if (cell.is_oracle() || cell.contact == "always") {
    scenarios::Scenario undelayed = scenario;
    undelayed.policy.delay = 0.0;
    source = recorded(scenarios::policy_contact(undelayed, *simulator), loop.trace);
  } else {
    const LegGeometry legs = scenarios::leg_geometry(*scenes.as_described(scenario));
    source = contact_source(
        estimator_of(experiment, cell, models, period, legs),
        {profile_of(request.sensors, experiment.sensors), sensor_key(experiment, run),
         cell.noise.levels(), noise_key(experiment, 0, run)},
        period, loop.trace);
  }
  loop.recording = scenarios::play(
      scenario, *simulator, experiment.seed, run,
      [&](double /*time*/) { return should_continue(); }, std::move(source));
  if (!should_continue()) throw Stopped();
  loop.scenario = std::move(scenario);
  return loop;
}

SavedClosedLoops::SavedClosedLoops(std::filesystem::path folder, std::string key)
    : folder_(std::move(folder)), key_(std::move(key)) {}

std::optional<ClosedLoopMetrics> SavedClosedLoops::read(std::size_t run) const {
  const std::string name = name_of(run);
  const std::optional<std::string> bytes =
      read_state(folder_ / name, fmt::format("{} loop {}", key_, name));
  ClosedLoopMetrics metrics;
  if (!bytes || bytes->size() != sizeof metrics) return std::nullopt;
  std::memcpy(&metrics, bytes->data(), sizeof metrics);
  return metrics;
}

void SavedClosedLoops::write(std::size_t run, const ClosedLoopMetrics& metrics) const {
  // The key contains the build, so the struct can be saved as it lies in memory.
  static_assert(std::is_trivially_copyable_v<ClosedLoopMetrics>);
  const std::string name = name_of(run);
  write_state(folder_ / name, fmt::format("{} loop {}", key_, name),
              {reinterpret_cast<const char*>(&metrics), sizeof metrics});
}

void run_closed_loops(const RunRequest& request, const TaskRange& runs, const FittedModels& models,
                      const SavedClosedLoops& saved, MissingRun missing,
                      const ShouldContinue& should_continue) {
  const std::vector<ClosedLoopCell> cells = closed_loop_cells(request.experiment);
  const auto of_cell = static_cast<std::size_t>(request.experiment.closed_loop->runs);
  scenarios::CompiledScenes scenes;
  Progress progress("closed loop", "runs", static_cast<std::int64_t>(runs.size()));
  tbb::parallel_for(runs.begin, runs.end, [&](std::size_t run) {
    if (!should_continue()) throw Stopped();
    if (!saved.read(run)) {
      if (missing == MissingRun::refuse) {
        throw Error(fmt::format("state/closed_loop/{} is missing", name_of(run)));
      }
      const ClosedLoopCell& cell = cells[run / of_cell];
      saved.write(run, rollout(request, cell, static_cast<std::int64_t>(run % of_cell), models,
                               scenes, should_continue));
    }
    progress.advance();
  });
}

}  // namespace touchdown::experiments
