#include "recordings/plausibility/constant_channels.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

namespace touchdown::recordings {

namespace {

constexpr std::int64_t least_records = 300;  // a third of a second at 1 kHz

std::string throughout(std::string_view channel, double value) {
  // 0 is added to show −0 as 0.
  return fmt::format("{} is {:.6g} throughout: is the sensor dead, or the column empty", channel,
                     value + 0.0);
}

}  // namespace

void ConstantChannels::Channel::add(double value) {
  if (!std::isfinite(value)) {
    ++missing;
    return;
  }
  if (count == 0) first = value;
  ++count;
  sum_of_sizes += std::abs(value);
  changes = changes || value != first;
}

bool ConstantChannels::Channel::is_constant() const { return count >= least_records && !changes; }

void ConstantChannels::add(const models::Observation& record) {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    joints_[i].position.add(record.servo[i].position);
    joints_[i].velocity.add(record.servo[i].velocity);
    joints_[i].torque.add(record.servo[i].torque);
  }
  const Eigen::Quaterniond& q = record.imu.orientation;
  const std::array<double, 4> orientation = {q.w(), q.x(), q.y(), q.z()};
  for (std::size_t i = 0; i < 4; ++i) orientation_[i].add(orientation[i]);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    angular_velocity_[i].add(record.imu.angular_velocity[axis]);
    linear_acceleration_[i].add(record.imu.linear_acceleration[axis]);
  }
}

/// Bad sensors drop out for a thousandth of the time (sensors/harsh.yaml).
void ConstantChannels::report_missing(std::string_view subject, const char* channel,
                                      const Channel& of_log, Findings& findings) {
  constexpr double most = 0.02;
  const double share =
      static_cast<double>(of_log.missing) / static_cast<double>(of_log.count + of_log.missing);
  if (!(share > most)) return;
  findings.add(subject, share == 1.0 ? fmt::format("{}is never a finite number", channel)
                                     : fmt::format("{}is missing in {:.0f} % of the records",
                                                   channel, 100.0 * share));
}

bool ConstantChannels::lacks_hips() const {
  constexpr std::size_t right = 3;
  return joints_[0].is_zero() && joints_[right].is_zero();
}

void ConstantChannels::report_joint(std::size_t servo, Findings& findings) const {
  const Joint& joint = joints_[servo];
  const std::string_view name = models::servo_names.at(servo);
  report_missing(name, "position ", joint.position, findings);
  report_missing(name, "velocity ", joint.velocity, findings);
  report_missing(name, "torque ", joint.torque, findings);
  if (servo % 3 == 0 && lacks_hips()) return;
  if (joint.torque.is_constant()) findings.add(name, throughout("torque", joint.torque.first));
  constexpr double moved = 0.1;  // rad/s, mean of its size
  const bool reports_motion =
      joint.velocity.sum_of_sizes > moved * static_cast<double>(joint.velocity.count);
  if (joint.position.is_constant() && reports_motion) {
    findings.add(name, throughout("position", joint.position.first));
  }
  if (joint.velocity.is_constant() && !joint.position.is_constant()) {
    findings.add(name, throughout("velocity", joint.velocity.first));
  }
}

void ConstantChannels::report_vector(const char* name, const std::array<Channel, 3>& axes,
                                     Findings& findings) {
  report_missing(name, "", axes[0], findings);
  const bool all =
      std::all_of(axes.begin(), axes.end(), [](const Channel& axis) { return axis.is_constant(); });
  if (all) {
    findings.add(name, fmt::format("is {:.6g} {:.6g} {:.6g} throughout: is the sensor dead, or the "
                                   "column empty",
                                   axes[0].first + 0.0, axes[1].first + 0.0, axes[2].first + 0.0));
    return;
  }
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (axes[i].is_constant()) {
      findings.add(fmt::format("{} {}", name, "xyz"[i]), throughout("it", axes[i].first));
    }
  }
}

void ConstantChannels::report(Findings& findings) const {
  for (std::size_t servo = 0; servo < joints_.size(); ++servo) report_joint(servo, findings);
  report_vector("angular_velocity", angular_velocity_, findings);
  report_vector("linear_acceleration", linear_acceleration_, findings);
  report_missing("orientation", "", orientation_[0], findings);
  if (std::all_of(orientation_.begin(), orientation_.end(),
                  [](const Channel& part) { return part.is_constant(); })) {
    findings.add("orientation", "never changes: is the sensor dead, or the column empty");
  }
}

}  // namespace touchdown::recordings
