#include "experiments/studies/closed_loop/rollout.hpp"

#include <new>

#include "core/error.hpp"
#include "experiments/fitting/fitting.hpp"
#include "experiments/plan/condition.hpp"
#include "experiments/plan/sensors.hpp"
#include "experiments/plan/served_robots.hpp"
#include "experiments/signals/motion.hpp"
#include "scenarios/engine.hpp"
#include "scenarios/policy_contact.hpp"

namespace touchdown::experiments {

namespace {

/// The estimator with the model that was fitted in this engine.
std::unique_ptr<ContactEstimator> estimator_of(const Experiment& experiment,
                                               const ClosedLoopCell& cell,
                                               const FittedModels& models, EstimatorSetup setup) {
  const EstimatorEntry entry =
      entry_of(experiment, {cell.simulator, cell.simulator, cell.contact}, models);
  setup.model = entry.fits() ? &models.at(model_key(cell.simulator, {})).at(entry.name) : nullptr;
  return entry.make(entry, setup);
}

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
    EstimatorSetup setup = robot_setup(experiment, scenario, scenes);
    setup.sample_rate = 1.0 / period;
    source = contact_source(
        estimator_of(experiment, cell, models, setup),
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

ClosedLoopMetrics measure_closed_loop(const RunRequest& request, std::size_t run,
                                      const FittedModels& models, scenarios::CompiledScenes& scenes,
                                      const ShouldContinue& should_continue) {
  const Experiment& experiment = request.experiment;
  const auto of_cell = static_cast<std::size_t>(experiment.studies.at<ClosedLoopConfig>().runs);
  const ClosedLoopCell cell = closed_loop_cells(experiment)[run / of_cell];
  try {
    const ClosedLoopRun loop = run_closed_loop(
        request, cell, static_cast<std::int64_t>(run % of_cell), models, scenes, should_continue);
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

}  // namespace touchdown::experiments
