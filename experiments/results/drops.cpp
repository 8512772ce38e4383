#include "experiments/results/drops.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/error.hpp"
#include "estimator/bayes/transition_model.hpp"
#include "experiments/estimators/entries.hpp"
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
