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
  const double sign = source.sign;
  return {
      in_our_convention(theirs.position, units.position, source.position_scale, sign, source.zero),
      in_our_convention(theirs.velocity, units.velocity, source.velocity_scale, sign),
      in_our_convention(theirs.torque, units.torque, source.torque_scale, sign)};
}

JointTarget target(const RobotRecord& record, const JointSource& source,
                   const RecordUnits& units) noexcept {
  if (source.index >= record.targets.size()) return {};
  const JointTarget& theirs = record.targets[source.index];
  const double sign = source.sign;
  return {
      in_our_convention(theirs.position, units.position, source.position_scale, sign, source.zero),
      in_our_convention(theirs.velocity, units.velocity, source.velocity_scale, sign),
      in_our_convention(theirs.feedforward_torque, units.torque, source.torque_scale, sign),
      units.kp * theirs.kp, units.kd * theirs.kd};
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
    for (const double scale : {joint.position_scale, joint.velocity_scale, joint.torque_scale}) {
      if (!std::isfinite(scale) || scale == 0.0) {
        throw InputError("assembly: a joint's scales must be finite and not 0");
      }
    }
  }
  constexpr double tolerance = 1e-3;  // of a matrix that is given with a few digits
  const Eigen::Matrix3d square = config.axes * config.axes.transpose();
  if (!square.isIdentity(tolerance) || !(config.axes.determinant() > 0.0)) {
    throw InputError("assembly: axes must be a rotation");
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

Eigen::Vector3d up_in_imu(const std::array<double, 4>& orientation) noexcept {
  const Eigen::Quaterniond q = quaternion(orientation);
  if (!is_orientation(q)) return Eigen::Vector3d::Constant(not_reported);
  return q.conjugate() * -Eigen::Vector3d::UnitZ();
}

Eigen::Matrix3d signed_axes(const std::array<std::string_view, 3>& names) noexcept {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Zero();
  for (Eigen::Index i = 0; i < 3; ++i) {
    std::string_view axis = names[static_cast<std::size_t>(i)];
    const double sign = axis.starts_with('-') ? -1.0 : 1.0;
    if (sign < 0.0) axis.remove_prefix(1);
    const std::size_t j = axis.size() == 1 ? std::string_view("xyz").find(axis) : 3;
    if (j < 3) axes(i, static_cast<Eigen::Index>(j)) = sign;
  }
  return axes.determinant() == 1.0 ? axes : Eigen::Matrix3d::Zero();
}

ImuSignals imu_of(const RobotRecord& record, const AssemblyConfig& config) noexcept {
  Eigen::Quaterniond q = quaternion(record.orientation);
  const bool is_mounted_otherwise = !config.axes.isIdentity(0.0);
  if (is_mounted_otherwise) q = q * Eigen::Quaterniond(Eigen::Matrix3d(config.axes.transpose()));
  // From z up to z down: half a turn about x.
  if (config.reference_is_z_up) q = Eigen::Quaterniond(-q.x(), q.w(), -q.z(), q.y());
  const auto converted = [&](double unit, const Eigen::Vector3d& theirs) -> Eigen::Vector3d {
    Eigen::Vector3d vector = unit * theirs;
    // Only then, so that one missing number stays one.
    if (is_mounted_otherwise) vector = config.axes * vector;
    return vector;
  };
  const RecordUnits& units = config.units;
  ImuSignals imu = {
      .orientation = {q.w(), q.x(), q.y(), q.z()},
      .angular_velocity = converted(units.angular_velocity, record.angular_velocity),
      .linear_acceleration = converted(units.linear_acceleration, record.linear_acceleration),
      .proper_acceleration = converted(units.linear_acceleration, record.proper_acceleration)};
  if (config.acceleration == AccelerationSource::proper) {
    const Eigen::Vector3d up(0.0, 0.0, -gravity_at_rest);
    imu.linear_acceleration = is_orientation(q)
                                  ? Eigen::Vector3d(imu.proper_acceleration - q.conjugate() * up)
                                  : Eigen::Vector3d::Constant(not_reported);
  }
  return imu;
}

Signals signals_of(const RobotRecord& record, const AssemblyConfig& config) noexcept {
  return signals_of(record, config, imu_of(record, config));
}

Signals signals_of(const RobotRecord& record, const AssemblyConfig& config,
                   const ImuSignals& imu) noexcept {
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
  signals.linear_acceleration = imu.linear_acceleration;
  signals.angular_velocity = imu.angular_velocity;
  signals.vertical_acceleration = upward(imu.orientation, imu.linear_acceleration);
  signals.up = up_in_imu(imu.orientation);
  signals.ground_velocity_command = record.ground_velocity_command;
  return signals;
}

}  // namespace touchdown
