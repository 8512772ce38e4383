#include "experiments/drops/posterior.hpp"

#include "estimator/phase/labels.hpp"
#include "experiments/estimators/filters.hpp"
#include "experiments/estimators/phase_fitting.hpp"
#include "experiments/fitting/make_estimator.hpp"
#include "experiments/plan/condition.hpp"

namespace touchdown::experiments {
namespace {

std::vector<Phase> true_phases(const RunSignals& run, const PhaseLabelConfig& config) {
  const double rate = 1e6 / static_cast<double>(run.info.control_period_us);
  std::vector<std::uint8_t> held, carried;
  if (may_be_held(run.info)) {
    held = held_steps(run.signals, rate, config);
    carried = carried_steps({run.normal_force[0], run.normal_force[1]}, held, rate, config);
  }
  return label_phases({WheelContact(run.contact[0]), WheelContact(run.contact[1])}, held, rate,
                      config, carried);
}

}  // namespace

DropPosterior drop_posterior(const Experiment& experiment, const PosteriorConfig& config,
                             const RunSignals& run, const FittedModels& models) {
  const DropWindow window =
      drop_window(run, config.choice, experiment.scoring.minimum_flight, "posterior");
  DropPosterior posterior;
  posterior.simulator = run.info.simulator;
  posterior.noise = config.noise;
  posterior.time =
      time_since_takeoff(window, 1e-6 * static_cast<double>(run.info.control_period_us));

  const Condition condition{run.info.simulator, run.info.simulator, "phase"};
  const EstimatorEntry entry = entry_of(condition, models);
  PhaseFilter filter = phase_filter(entry, setup_of(condition, models, run));
  const NoiseRun noise = noise_run(run, noise_key(experiment, config.choice.seed, run.info.run));
  const noise::SensorNoise levels = config.noise.levels();
  const std::vector<Phase> truth = true_phases(run, entry.phase->fit.labels);
  Belief belief;
  for (std::size_t k = 0; k < window.end; ++k) {
    if (is_heard(run.signals[k])) belief = filter.update(noisy(run, noise, levels, k));
    if (k < window.begin) continue;
    posterior.truth.push_back(truth[k]);
    posterior.phases.push_back(filter.phases());
    for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
      posterior.contact[wheel].push_back(run.contact[wheel][k]);
      posterior.p_contact[wheel].push_back(belief.wheel[wheel].p_contact);
    }
  }
  return posterior;
}

}  // namespace touchdown::experiments
