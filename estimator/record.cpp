#include "estimator/record.hpp"

#include <cmath>

#include <Eigen/Geometry>

#include "core/error.hpp"

namespace touchdown {

namespace {

/// Whether the quaternion has length one, up to the rounding of sensors and log formats.
bool is_orientation(const Eigen::Quaterniond& q) noexcept {
  constexpr double tolerance = 0.02;
  return std::abs(q.squaredNorm() - 1.0) <= tolerance;  // written so that NaN fails
}

Eigen::Quaterniond quaternion(const std::array<double, 4>& q) noexcept {
  return {q[0], q[1], q[2], q[3]};
}

JointSignals joint(const RobotRecord& record, const JointSource& source,
                   const RecordUnits& units) noexcept {
  if (source.index >= record.joints.size()) return {not_reported, not_reported, not_reported};
  const JointSignals& theirs = record.joints[source.index];
  return {source.sign * (units.position * theirs.position - source.zero),
          source.sign * (units.velocity * theirs.velocity),
          source.sign * (units.torque * theirs.torque)};
}

JointTarget target(const RobotRecord& record, const JointSource& source,
                   const RecordUnits& units) noexcept {
  if (source.index >= record.targets.size()) return {};
  const JointTarget& theirs = record.targets[source.index];
  return {source.sign * (units.position * theirs.position - source.zero),
          source.sign * (units.velocity * theirs.velocity),
          source.sign * (units.torque * theirs.feedforward_torque), units.kp * theirs.kp,
          units.kd * theirs.kd};
}

/// The acceleration without gravity, in the IMU's frame.
Eigen::Vector3d linear_acceleration(const RobotRecord& record,
                                    const AssemblyConfig& config) noexcept {
  const double unit = config.units.linear_acceleration;
  if (config.acceleration == AccelerationSource::without_gravity) {
    return unit * record.linear_acceleration;
  }
  const Eigen::Quaterniond orientation = quaternion(record.orientation);
  if (!is_orientation(orientation)) return Eigen::Vector3d::Constant(not_reported);
  const Eigen::Vector3d up(0.0, 0.0, config.reference_is_z_up ? gravity_at_rest : -gravity_at_rest);
  return unit * record.proper_acceleration - orientation.conjugate() * up;
}

bool is_positive(double value) { return std::isfinite(value) && value > 0.0; }

}  // namespace

void check_assembly_config(const AssemblyConfig& config) {
  const RecordUnits& units = config.units;
  for (const double unit :
       {units.time, units.position, units.velocity, units.torque, units.angular_velocity,
        units.linear_acceleration, units.kp, units.kd}) {
    if (!is_positive(unit)) throw InputError("assembly: units must be positive");
  }
  for (const JointSource& joint : config.joints) {
    if (std::abs(joint.sign) != 1.0) throw InputError("assembly: a joint's sign must be 1 or -1");
    if (!std::isfinite(joint.zero)) throw InputError("assembly: a joint's zero must be finite");
  }
  if (!is_positive(config.sample_rate)) {
    throw InputError("assembly: the sample rate must be positive (Hz)");
  }
  if (!is_positive(config.rate_tolerance) || !is_positive(config.gravity_memory)) {
    throw InputError("assembly: rate_tolerance and gravity_memory must be positive");
  }
  if (!(config.stale_after >= 0.0 && config.maximum_gap >= 0.0)) {
    throw InputError("assembly: stale_after and maximum_gap must not be negative (s)");
  }
}

double upward(const std::array<double, 4>& orientation, const Eigen::Vector3d& vector,
              bool reference_is_z_up) noexcept {
  const Eigen::Quaterniond q = quaternion(orientation);
  if (!is_orientation(q)) return not_reported;
  const double z = (q * vector).z();
  return reference_is_z_up ? z : -z;
}

Signals signals_of(const RobotRecord& record, const AssemblyConfig& config) noexcept {
  Signals signals;
  signals.time = config.units.time * record.time;
  for (std::size_t side = 0; side < 2; ++side) {
    signals.leg[side] = {joint(record, config.joints[3 * side], config.units),
                         joint(record, config.joints[3 * side + 1], config.units),
                         joint(record, config.joints[3 * side + 2], config.units)};
    signals.target[side] = {target(record, config.joints[3 * side], config.units),
                            target(record, config.joints[3 * side + 1], config.units),
                            target(record, config.joints[3 * side + 2], config.units)};
  }
  signals.linear_acceleration = linear_acceleration(record, config);
  signals.angular_velocity = config.units.angular_velocity * record.angular_velocity;
  signals.vertical_acceleration =
      upward(record.orientation, signals.linear_acceleration, config.reference_is_z_up);
  signals.ground_velocity_command = record.ground_velocity_command;
  return signals;
}

}  // namespace touchdown
