#include "experiments/drops/detail.hpp"

#include <algorithm>
#include <cmath>

#include "estimator/bayes/transition_model.hpp"
#include "experiments/config/experiment_estimators.hpp"
#include "experiments/fitting/fitting.hpp"
#include "experiments/plan/condition.hpp"

namespace touchdown::experiments {

namespace {

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
    if (entry.config) return entry;
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

DropDetail drop_detail(const Experiment& experiment, const DetailConfig& config,
                       const recordings::Recording& recording, const RunSignals& run,
                       const FittedModels& models) {
  const DropWindow window =
      drop_window(run, config.choice, experiment.scoring.minimum_flight, "detail");
  const double rate = 1e6 / static_cast<double>(run.info.control_period_us);
  const Condition shown{run.info.simulator, run.info.simulator,
                        spectrum_entry(experiment, config.estimators).name};
  const EstimatorEntry entry = entry_of(experiment, shown, models);
  const TransitionConfig& transition = entry.config->transition;

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

}  // namespace touchdown::experiments
