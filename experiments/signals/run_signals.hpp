#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "estimator/contact_estimator.hpp"
#include "estimator/force/leg_geometry.hpp"
#include "estimator/odometry/wheeled_leg.hpp"
#include "estimator/signals.hpp"
#include "logs/recording.hpp"
#include "models/robot_model.hpp"
#include "noise/sensor_noise.hpp"
#include "scoring/bootstrap.hpp"
#include "scoring/labels.hpp"
#include "scoring/score.hpp"
#include "scoring/trajectory.hpp"

namespace touchdown::experiments {

/// The data of a run that odometry needs besides the signals.
struct RunMotion {
  odometry::WheeledBiped robot;                 ///< from the robot's description
  std::vector<Eigen::Vector3d> specific_force;  ///< reported by the accelerometer (m/s²)
  scoring::Trajectory truth;  ///< pose of the IMU's origin, with the axes of the base
};

/// Errors: `InputError` for a robot with joints that do not turn about ±y, see `wheeled_biped`.
RunMotion motion_of(const logs::Recording& recording, const models::RobotModel& robot);

/// The kinematic model for odometry, from the robot's MuJoCo model. It assumes planar legs. Errors:
/// `InputError` when a joint does not turn about ±y.
odometry::WheeledBiped wheeled_biped(const models::RobotModel& robot);

/// Whether the step was recorded. Estimators are not updated at steps without a record.
inline bool has_record(const Signals& signals) { return !std::isnan(signals.time); }

/// The data that a study keeps of a recording: the signals at every step and the ground truth.
struct RunSignals {
  logs::RecordingInfo info;
  /// Time from the beginning of the log to the first step (s). Only the beginning of a log is
  /// skipped, not that of each of its segments.
  double start = 0.0;
  std::vector<Signals> signals;                                       ///< noiseless
  std::array<scoring::ContactSequence, models::wheel_count> contact;  ///< labels
  std::array<std::vector<double>, models::wheel_count> normal_force;  ///< truth, per wheel (N)
  std::vector<std::size_t> segments;             ///< first step of each statistical sample
  LegGeometry legs = {};                         ///< of the robot, from its file
  std::shared_ptr<const RunMotion> motion = {};  ///< of test runs, if odometry is studied

  std::size_t steps() const { return signals.size(); }
  /// Control period (s).
  double period() const { return 1e-6 * static_cast<double>(info.control_period_us); }
  /// Control rate (Hz).
  double sample_rate() const { return 1e6 / static_cast<double>(info.control_period_us); }
};

/// Runs that others hold. Fits read them in place: their signals are most of an experiment's
/// memory.
using RunPointers = std::vector<const RunSignals*>;

/// `runs` must outlive the result.
RunPointers pointers_to(const std::vector<RunSignals>& runs);

/// Errors: `InputError` when the recording has no ground truth.
RunSignals signals_of(const logs::Recording& recording, const scoring::LabelConfig& labels,
                      const scoring::ScoringConfig& scoring, scoring::SampleUnit unit);

/// Draws for each joint of one leg, per step: hip, knee, wheel.
struct JointNoise {
  std::array<std::vector<double>, 3> torque;
  std::array<std::vector<double>, 3> position;
  std::array<std::vector<double>, 3> velocity;
};

/// Standard normal draws for all signals of one run. Each noise level of a sweep scales them. The
/// draws equal those of `with_noise` with the same key.
struct NoiseRun {
  std::array<JointNoise, models::wheel_count> joint;
  std::array<std::vector<double>, 3> acceleration;  ///< in the IMU frame
  std::vector<double> vertical_acceleration;        ///< the same, along the world's vertical
};

NoiseRun noise_run(const RunSignals& run, const noise::NoiseKey& key);

/// Adds noise to joint positions and velocities. `noisy` calls it only for levels with such noise.
void add_encoder_noise(Signals& signals, const NoiseRun& noise, const noise::SensorNoise& levels,
                       std::size_t step);

/// The signals at `step` with sensor noise of these levels.
inline Signals noisy(const RunSignals& run, const NoiseRun& noise, const noise::SensorNoise& levels,
                     std::size_t step) {
  Signals signals = run.signals[step];
  for (std::size_t leg = 0; leg < models::wheel_count; ++leg) {
    const auto& torque = noise.joint[leg].torque;
    signals.leg[leg].hip.torque += levels.hip_torque * torque[0][step];
    signals.leg[leg].knee.torque += levels.knee_torque * torque[1][step];
    signals.leg[leg].wheel.torque += levels.wheel_torque * torque[2][step];
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    signals.linear_acceleration[static_cast<int>(axis)] +=
        levels.acceleration * noise.acceleration[axis][step];
  }
  signals.vertical_acceleration += levels.acceleration * noise.vertical_acceleration[step];
  if (levels.joint_position > 0.0 || levels.joint_velocity > 0.0) {
    add_encoder_noise(signals, noise, levels, step);
  }
  return signals;
}

}  // namespace touchdown::experiments
