#include "experiments/submissions/exported_arrays.hpp"

#include <functional>

namespace touchdown::experiments {

namespace {

/// An array with `columns` numbers per step, appended by `put`.
template <typename Put>
ModelArray array_of(const std::vector<Signals>& steps, std::size_t columns, const Put& put) {
  ModelArray array{{steps.size()}, {}};
  if (columns > 1) array.shape.push_back(columns);
  array.data.reserve(steps.size() * columns);
  for (const Signals& signals : steps) put(signals, array.data);
  return array;
}

ModelArray joints(const std::vector<Signals>& steps, double JointSignals::*member) {
  return array_of(steps, 6, [&](const Signals& signals, std::vector<double>& data) {
    for (const LegSignals& leg : signals.leg) {
      data.insert(data.end(), {leg.hip.*member, leg.knee.*member, leg.wheel.*member});
    }
  });
}

ModelArray targets(const std::vector<Signals>& steps, double JointTarget::*member) {
  return array_of(steps, 6, [&](const Signals& signals, std::vector<double>& data) {
    for (const LegTargets& leg : signals.target) {
      data.insert(data.end(), {leg.hip.*member, leg.knee.*member, leg.wheel.*member});
    }
  });
}

ModelArray vectors(const std::vector<Signals>& steps, Eigen::Vector3d Signals::*member) {
  return array_of(steps, 3, [&](const Signals& signals, std::vector<double>& data) {
    data.insert(data.end(), (signals.*member).begin(), (signals.*member).end());
  });
}

ModelArray numbers(const std::vector<Signals>& steps, double Signals::*member) {
  return array_of(steps, 1, [&](const Signals& signals, std::vector<double>& data) {
    data.push_back(signals.*member);
  });
}

ModelArrays arrays_of(const RunSignals& run,
                      const std::function<Signals(std::size_t step)>& signals_at) {
  std::vector<Signals> steps;
  steps.reserve(run.steps());
  ModelArray recorded{{run.steps()}, {}};
  ModelArray contact{{run.steps(), models::wheel_count}, {}};
  for (std::size_t k = 0; k < run.steps(); ++k) {
    steps.push_back(signals_at(k));
    recorded.data.push_back(has_record(steps.back()) ? 1.0 : 0.0);
    if (!has_record(steps.back())) {
      steps.back().time =
          1e-6 * static_cast<double>(run.info.control_period_us) * static_cast<double>(k);
    }
    for (const scoring::ContactSequence& label : run.contact) {
      contact.data.push_back(label[k] != 0 ? 1.0 : 0.0);
    }
  }
  return {{"time", numbers(steps, &Signals::time)},
          {"has_record", std::move(recorded)},
          {"position", joints(steps, &JointSignals::position)},
          {"velocity", joints(steps, &JointSignals::velocity)},
          {"torque", joints(steps, &JointSignals::torque)},
          {"linear_acceleration", vectors(steps, &Signals::linear_acceleration)},
          {"angular_velocity", vectors(steps, &Signals::angular_velocity)},
          {"vertical_acceleration", numbers(steps, &Signals::vertical_acceleration)},
          {"ground_velocity_command", numbers(steps, &Signals::ground_velocity_command)},
          {"target_position", targets(steps, &JointTarget::position)},
          {"target_velocity", targets(steps, &JointTarget::velocity)},
          {"target_torque", targets(steps, &JointTarget::feedforward_torque)},
          {"target_kp", targets(steps, &JointTarget::kp)},
          {"target_kd", targets(steps, &JointTarget::kd)},
          {"contact", std::move(contact)}};
}

}  // namespace

ModelArrays exported_arrays(const RunSignals& run) {
  return arrays_of(run, [&](std::size_t step) { return run.signals[step]; });
}

ModelArrays exported_arrays(const RunSignals& run, const NoiseRun& noise,
                            const noise::SensorNoise& levels) {
  return arrays_of(run, [&](std::size_t step) { return noisy(run, noise, levels, step); });
}

double bytes_of_exported(double steps) {
  constexpr double numbers = 1 + 1 + 3 * 6 + 2 * 3 + 1 + 1 + 5 * 6 + 2;
  constexpr double heads = 15 * 300.0;
  return heads + numbers * sizeof(double) * steps;
}

}  // namespace touchdown::experiments
