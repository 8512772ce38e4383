#include "experiments/estimators/entry.hpp"

namespace touchdown::experiments {

noise::SensorNoise noise_of(const Sensors& sensors, const noise::SensorNoise& levels) {
  return {.knee_torque = sensors.knee_torque ? levels.knee_torque : 0.0,
          .wheel_torque = sensors.wheel_torque ? levels.wheel_torque : 0.0,
          .acceleration = sensors.acceleration ? levels.acceleration : 0.0,
          .joint_position = sensors.joint_position ? levels.joint_position : 0.0,
          .joint_velocity = sensors.joint_velocity ? levels.joint_velocity : 0.0,
          .hip_torque = sensors.hip_torque ? levels.hip_torque : 0.0};
}

Listener listener_of(const EstimatorEntry& entry, const EstimatorSetup& setup) {
  return entry.at_once ? Listener(entry.at_once(setup)) : Listener(entry.make(entry, setup));
}

bool share_model(const EstimatorEntry& one, const EstimatorEntry& other) {
  if (one.fit == nullptr || one.fit != other.fit || one.fits() != other.fits()) return false;
  if (one.config) return one.config->measurement == other.config->measurement;
  return !one.phase || one.phase->fit == other.phase->fit;
}

}  // namespace touchdown::experiments
