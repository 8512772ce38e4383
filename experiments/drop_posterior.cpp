#include "experiments/drop_posterior.hpp"

#include "core/error.hpp"
#include "estimator/phase_filter.hpp"
#include "estimator/phase_labels.hpp"
#include "experiments/estimator_registry.hpp"
#include "experiments/phase_fitting.hpp"
#include "experiments/sweep.hpp"

namespace touchdown {

namespace {

std::vector<Phase> true_phases(const HeardRun& run, const PhaseLabelConfig& config) {
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
                             const HeardRun& run, const FittedModels& models) {
  const DropWindow window =
      drop_window(run, config.choice, experiment.scoring.minimum_flight, "posterior");
  DropPosterior posterior;
  posterior.simulator = run.info.simulator;
  posterior.noise = config.noise;
  posterior.time =
      time_since_takeoff(window, 1e-6 * static_cast<double>(run.info.control_period_us));

  const Condition condition{run.info.simulator, run.info.simulator, "phase"};
  const auto estimator = make_estimator(condition, models, run.info.control_period_us);
  const auto* filter = dynamic_cast<const PhaseFilter*>(estimator.get());
  if (filter == nullptr) throw Error("the estimator 'phase' is no phase filter");
  const UnitNoise noise = unit_noise(run, noise_key(experiment, config.choice.seed, run.info.run));
  const NoiseLevels levels = config.noise.levels();
  const std::vector<Phase> truth = true_phases(run, estimator_entry("phase").phase->fit.labels);
  begin(*estimator, run);
  for (std::size_t k = 0; k < window.end; ++k) {
    const Belief& belief = estimator->update(noisy(run, noise, levels, k));
    if (k < window.begin) continue;
    posterior.truth.push_back(truth[k]);
    posterior.phases.push_back(filter->phases());
    for (std::size_t wheel = 0; wheel < wheel_count; ++wheel) {
      posterior.contact[wheel].push_back(run.contact[wheel][k]);
      posterior.p_contact[wheel].push_back(belief.wheel[wheel].p_contact);
    }
  }
  return posterior;
}

}  // namespace touchdown
