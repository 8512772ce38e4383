#include "experiments/drops/posterior.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "estimator/phase/labels.hpp"
#include "estimator/phase/prepared_model.hpp"
#include "experiments/estimators/entries.hpp"
#include "experiments/estimators/fits.hpp"
#include "experiments/fitting/fitting.hpp"
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

PhaseProbabilities by_phase(const PhaseRow& left_leg, const PhaseRow& right_leg,
                            const PhaseRow& vertical) {
  const PhaseRecursion::Lanes evidence = PhaseRecursion::evidence(left_leg, right_leg, vertical);
  PhaseProbabilities phases{};
  std::copy_n(evidence.begin(), phase_count, phases.begin());
  return phases;
}

/// Log likelihoods of the filter's last step by its own densities, at the noise that it assumed.
/// Signals that are not finite contribute nothing.
PhaseEvidence evidence_of(const PreparedPhaseModel& model, const PhaseNoise& noise,
                          const Signals& signals) {
  const auto leg = [&](std::size_t side) {
    const double mirror = side == 0 ? 1.0 : -1.0;
    const double knee = mirror * signals.leg[side].knee.torque;
    const double wheel = mirror * signals.leg[side].wheel.torque;
    if (!std::isfinite(knee) || !std::isfinite(wheel)) return PhaseRow{};
    return model.torque(knee, wheel, model.torque.noise_levels().place(noise.knee_torque),
                        model.torque.noise_levels().place(noise.wheel_torque));
  };
  const PhaseRow vertical =
      std::isfinite(signals.vertical_acceleration)
          ? model.acceleration(signals.vertical_acceleration,
                               model.acceleration.noise_levels().place(noise.acceleration))
          : PhaseRow{};
  return {by_phase(leg(0), {}, {}), by_phase({}, leg(1), {}), by_phase({}, {}, vertical)};
}

LogLikelihoodError error_by(const PhaseEvidence& evidence, const PhaseProbabilities& belief,
                            Phase truth) {
  const auto first = std::max_element(belief.begin(), belief.end());
  const auto phase = static_cast<Phase>(first - belief.begin());
  if (left_in_contact(phase) == left_in_contact(truth) &&
      right_in_contact(phase) == right_in_contact(truth)) {
    return {};
  }
  const auto preference = [&](const PhaseProbabilities& of) {
    return of[index(phase)] - of[index(truth)];
  };
  const double least = std::numeric_limits<double>::min();
  const double whole = std::log(*first / std::max(least, belief[index(truth)]));
  LogLikelihoodError error{preference(evidence.left), preference(evidence.right),
                           preference(evidence.acceleration)};
  error.memory = whole - error.left - error.right - error.acceleration;
  return error;
}

}  // namespace

DropPosterior drop_posterior(const Experiment& experiment, const PosteriorConfig& config,
                             const RunSignals& run, const FittedModels& models) {
  const DropWindow window =
      drop_window(run, config.choice, experiment.scoring.minimum_flight, "posterior");
  DropPosterior posterior;
  posterior.simulator = run.info.simulator;
  posterior.noise = config.noise;
  posterior.at = config.choice.at;
  posterior.time = time_in(window, 1e-6 * static_cast<double>(run.info.control_period_us));

  const Condition condition{run.info.simulator, run.info.simulator, "phase"};
  const EstimatorEntry entry = entry_of(experiment, condition, models);
  const EstimatorSetup setup = setup_of(experiment, condition, models, run);
  PhaseFilter filter = phase_filter(entry, setup);
  const PreparedPhaseModel prepared(phase_model(setup), filter.config());
  const NoiseRun noise = noise_run(run, noise_key(experiment, config.choice.seed, run.info.run));
  const noise::SensorNoise levels = config.noise.levels();
  const std::vector<Phase> truth = true_phases(run, entry.phase->fit.labels);
  Belief belief;
  PhaseEvidence evidence;
  for (std::size_t k = 0; k < window.end; ++k) {
    if (has_record(run.signals[k])) {
      const Signals signals = noisy(run, noise, levels, k);
      belief = filter.update(signals);
      if (k >= window.begin) evidence = evidence_of(prepared, filter.noise(), signals);
    }
    if (k < window.begin) continue;
    posterior.truth.push_back(truth[k]);
    posterior.evidence.push_back(evidence);
    posterior.phases.push_back(filter.phases());
    posterior.log_likelihood_error.push_back(error_by(evidence, filter.phases(), truth[k]));
    for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
      posterior.contact[wheel].push_back(run.contact[wheel][k]);
      posterior.p_contact[wheel].push_back(belief.wheel[wheel].p_contact);
    }
  }
  return posterior;
}

}  // namespace touchdown::experiments
