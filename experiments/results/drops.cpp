#include "experiments/results/drops.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/error.hpp"
#include "estimator/bayes/transition_model.hpp"
#include "estimator/phase/labels.hpp"
#include "estimator/phase/prepared_model.hpp"
#include "experiments/estimators/entries.hpp"
#include "experiments/estimators/fits.hpp"
#include "experiments/fitting/fitting.hpp"
#include "experiments/plan/condition.hpp"

namespace touchdown::experiments {

namespace {

std::vector<Phase> true_phases(const RunSignals& run, const PhaseLabelConfig& config) {
  const double rate = run.sample_rate();
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
  const PhaseRow legs = legs_row(left_leg, right_leg);
  PhaseProbabilities phases{};
  for (std::size_t k = 0; k < phase_count; ++k) {
    phases[k] = static_cast<double>(legs[k] + vertical[k]);
  }
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

constexpr std::size_t left = 0;

template <typename T>
std::vector<T> inside(const std::vector<T>& whole, const DropWindow& window) {
  const auto at = [&](std::size_t k) { return whole.begin() + static_cast<std::ptrdiff_t>(k); };
  return {at(window.begin), at(window.end)};
}

/// The estimator with the transition model that is shown.
const EstimatorEntry& spectrum_entry(const Experiment& experiment,
                                     const std::vector<std::string>& estimators) {
  for (const std::string& name : estimators) {
    const EstimatorEntry& entry = estimator_entry(experiment, name);
    if (entry.fitting.torques) return entry;
  }
  return estimator_entry(experiment, "robust");
}

std::vector<double> spectrum_now(const SlidingDft& dft) {
  std::vector<double> column;
  for (int bin = 0; bin < dft.bins(); ++bin) {
    column.push_back(dft.squared_magnitude(bin) / dft.window());
  }
  return column;
}

SpectrumTrace trace_spectrum(const TransitionConfig& config, double rate, const DropWindow& window,
                             const std::vector<Signals>& signals) {
  TransitionModel model(config, rate);
  SpectrumTrace trace;
  for (std::size_t k = 0; k < window.end; ++k) {
    const double acceleration = signals[k].vertical_acceleration;
    // As in the filter: values that are not finite are skipped.
    if (std::isfinite(acceleration)) model.update(acceleration);
    const Transition& transition = model.transition();
    if (k < window.begin) continue;
    trace.acceleration.push_back(acceleration);
    trace.power.push_back(transition.power);
    trace.median_frequency.push_back(transition.median_frequency);
    trace.p_switch.push_back(transition.p_switch);
    trace.p_takeoff.push_back(transition.contact_to_air);
    trace.p_landing.push_back(transition.air_to_contact);
    if ((k - window.begin) % spectrum_stride == 0) {
      trace.spectrum.push_back(spectrum_now(model.spectrum()));
    }
  }
  return trace;
}

TorqueTrace trace_torque(const DropWindow& window, const std::vector<Signals>& signals) {
  TorqueTrace trace;
  for (std::size_t k = window.begin; k < window.end; ++k) {
    trace.knee.push_back(signals[k].leg[left].knee.torque);
    trace.wheel.push_back(signals[k].leg[left].wheel.torque);
  }
  return trace;
}

/// NaN before the first measurement.
std::vector<double> trace_torque_evidence(const Experiment& experiment, const Condition& shown,
                                          const FittedModels& models, const RunSignals& run,
                                          const DropWindow& window,
                                          const std::vector<Signals>& signals) {
  const auto& names = experiment.estimators;
  if (std::find(names.begin(), names.end(), shown.estimator) == names.end()) {
    return std::vector<double>(window.steps(), Evidence::unknown);
  }
  const std::unique_ptr<ContactEstimator> filter = make_estimator(experiment, shown, models, run);
  std::vector<double> trace;
  for (std::size_t k = 0; k < window.end; ++k) {
    if (has_record(signals[k])) filter->update(signals[k]);
    if (k < window.begin) continue;
    const Evidence::Measurement measurement = filter->evidence().wheel[left];
    trace.push_back(std::log(measurement.contact_likelihood / measurement.no_contact_likelihood));
  }
  return trace;
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
  posterior.time = time_in(window, run.period());

  const Condition condition{run.info.simulator, run.info.simulator, "phase"};
  const EstimatorEntry entry = entry_of(experiment, condition, models);
  const EstimatorSetup setup = setup_of(experiment, condition, models, run);
  PhaseFilter filter = phase_filter(entry, setup);
  const PreparedPhaseModel prepared(setup.model->phase, filter.config());
  const NoiseRun noise = noise_run(run, noise_key(experiment, config.choice.seed, run.info.run));
  const noise::SensorNoise levels = config.noise.levels();
  const std::vector<Phase> truth = true_phases(run, entry.fitting.phases->labels);
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

DropDetail drop_detail(const Experiment& experiment, const DetailConfig& config,
                       const logs::Recording& recording, const RunSignals& run,
                       const FittedModels& models) {
  const DropWindow window =
      drop_window(run, config.choice, experiment.scoring.minimum_flight, "detail");
  const double rate = run.sample_rate();
  const Condition shown{run.info.simulator, run.info.simulator,
                        spectrum_entry(experiment, config.estimators).name};
  const EstimatorEntry entry = entry_of(experiment, shown, models);
  const TransitionConfig transition = transition_of(entry);

  DropDetail detail;
  detail.simulator = run.info.simulator;
  detail.at = config.choice.at;
  detail.time = time_in(window, 1.0 / rate);
  detail.contact = inside(run.contact[left], window);
  const double start = recording.truth[window.zero].base_position.z();
  for (std::size_t k = window.begin; k < window.end; ++k) {
    detail.height.push_back(recording.truth[k].base_position.z() - start);
  }
  detail.bin_width = rate / transition.window;
  detail.transition_of = entry.name;
  detail.switch_power = transition.switch_sigmoid.offset;

  detail.torque = trace_torque(window, run.signals);
  detail.spectrum = trace_spectrum(transition, rate, window, run.signals);
  const NoiseRun noise = noise_run(run, noise_key(experiment, config.choice.seed, run.info.run));
  for (const noise::NoiseCell& cell : config.noise) {
    const noise::SensorNoise levels = cell.levels();
    std::vector<Signals> signals;
    for (std::size_t k = 0; k < window.end; ++k) signals.push_back(noisy(run, noise, levels, k));
    NoisyDrop drop{cell,
                   trace_torque(window, signals),
                   trace_torque_evidence(experiment, shown, models, run, window, signals),
                   trace_spectrum(transition, rate, window, signals),
                   {}};
    for (const std::string& name : config.estimators) {
      EstimatorRunner runner =
          runner_of(experiment, {detail.simulator, detail.simulator, name}, models, run);
      const scoring::Prediction prediction = predict(runner, run, noise, levels);
      drop.beliefs.push_back({name, estimator_entry(experiment, name).title,
                              inside(prediction[left].p_contact, window)});
    }
    detail.noisy.push_back(std::move(drop));
  }
  return detail;
}

std::vector<scoring::Flight> drops(
    const std::array<scoring::ContactSequence, models::wheel_count>& contact, double period,
    double minimum_flight, DropWheels wheels) {
  std::vector<scoring::Flight> found =
      scoring::flights(wheels == DropWheels::both   ? scoring::any_wheel(contact)
                       : wheels == DropWheels::left ? contact[0]
                                                    : contact[1]);
  std::erase_if(found, [&](const scoring::Flight& flight) {
    const auto steps = static_cast<double>(flight.landing - flight.takeoff);
    return flight.takeoff == 0 || steps * period < minimum_flight;
  });
  return found;
}

std::string_view to_text(DropWheels wheels) {
  constexpr std::array<std::string_view, 3> texts = {"both wheels", "the left wheel",
                                                     "the right wheel"};
  return texts.at(static_cast<std::size_t>(wheels));
}

namespace {

std::size_t step_at(const RunSignals& run, double at, double period, const std::string& key) {
  const auto step = static_cast<std::size_t>(std::llround(at / period));
  if (step < run.steps()) return step;
  throw InputError(fmt::format("{}.at: run {} in {} ends after {:.6g} s", key, run.info.run,
                               run.info.simulator, static_cast<double>(run.steps()) * period));
}

std::size_t takeoff_of(const RunSignals& run, const DropChoice& choice, double period,
                       double minimum_flight, const std::string& key) {
  const std::vector<scoring::Flight> found =
      drops(run.contact, period, minimum_flight, choice.wheels);
  const auto number = static_cast<std::size_t>(choice.drop);
  if (number >= found.size()) {
    const std::string have =
        found.empty()
            ? fmt::format("no drop of {}", to_text(choice.wheels))
            : fmt::format("{} drop{} of {}, counted from 0; none is number {}", found.size(),
                          found.size() == 1 ? "" : "s", to_text(choice.wheels), choice.drop);
    throw InputError(
        fmt::format("{}.drop: run {} in {} has {}", key, run.info.run, run.info.simulator, have));
  }
  return found[number].takeoff;
}

}  // namespace

DropWindow drop_window(const RunSignals& run, const DropChoice& choice, double minimum_flight,
                       const std::string& key) {
  const double period = run.period();
  const std::size_t zero = choice.at ? step_at(run, *choice.at, period, key)
                                     : takeoff_of(run, choice, period, minimum_flight, key);
  const auto steps = [&](double seconds) {
    return static_cast<std::size_t>(std::llround(seconds / period));
  };
  return {zero - std::min(zero, steps(choice.before)),
          std::min(run.steps(), zero + steps(choice.after) + 1), zero};
}

std::vector<double> time_in(const DropWindow& window, double period) {
  std::vector<double> time;
  for (std::size_t k = window.begin; k < window.end; ++k) {
    time.push_back((static_cast<double>(k) - static_cast<double>(window.zero)) * period);
  }
  return time;
}

}  // namespace touchdown::experiments
