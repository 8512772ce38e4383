#include "apps/python/signal_arrays.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "logs/sample_times.hpp"

namespace touchdown::python {

namespace {

constexpr std::size_t joint_count = 6;

/// The joints of a leg in the order of the arrays, which have the left leg first.
constexpr std::array leg_joints = {&LegSignals::hip, &LegSignals::knee, &LegSignals::wheel};
constexpr std::array leg_targets = {&LegTargets::hip, &LegTargets::knee, &LegTargets::wheel};

/// `count` numbers of one step, by name, as an array of one step.
StepArray numbers_of(const py::object& step, const char* name, std::size_t count) {
  const std::string expected = count == 1 ? "a number" : fmt::format("{} numbers", count);
  if (!step.contains(name)) {
    throw InputError(fmt::format("signals: '{}' is missing: expected {}", name, expected));
  }
  auto array = StepArray::Array::ensure(step[name]);
  if (!array || array.size() != static_cast<py::ssize_t>(count) || array.ndim() > 1) {
    throw InputError(fmt::format("signals: '{}': expected {}", name, expected));
  }
  return StepArray(
      StepArray::Array(array.reshape({py::ssize_t{1}, static_cast<py::ssize_t>(count)})));
}

/// Whether the vertical acceleration follows from acceleration and orientation.
bool is_derived(const py::object& arrays, const SignalNeeds& needs, const AssemblyConfig& imu) {
  if (!needs.acceleration) return false;
  if (imu.acceleration == AccelerationSource::proper) return true;
  return !arrays.contains("vertical_acceleration") && arrays.contains("orientation");
}

/// Turns the vectors of the IMU into Upkie's axes, and sets the vertical from its orientation (w x
/// y z), if there is one. `derives`: also the accelerations, from the one of the IMU.
void convert_imu(Signals& signals, const std::optional<std::array<double, 4>>& orientation,
                 bool derives, const AssemblyConfig& config) {
  RobotRecord record{.angular_velocity = signals.angular_velocity,
                     .linear_acceleration = signals.linear_acceleration,
                     .proper_acceleration = signals.linear_acceleration};
  if (orientation) record.orientation = *orientation;
  const ImuSignals imu = imu_of(record, config);
  signals.angular_velocity = imu.angular_velocity;
  // Gravity stays where no estimator needs the vertical acceleration.
  signals.linear_acceleration = derives ? imu.linear_acceleration : imu.proper_acceleration;
  if (derives) signals.vertical_acceleration = upward(imu.orientation, imu.linear_acceleration);
  if (orientation) signals.up = up_in_imu(imu.orientation);
}

}  // namespace

StepArray SignalArrays::column(const char* name, std::size_t columns) {
  return is_one_step_ ? numbers_of(arrays_, name, std::max<std::size_t>(columns, 1))
                      : map_.column(name, columns);
}

std::optional<StepArray> SignalArrays::column(const char* name, std::size_t columns,
                                              bool is_needed) {
  if (!is_needed && !map_.has(name)) return std::nullopt;
  return column(name, columns);
}

SignalArrays::SignalArrays(const py::object& arrays, const SignalNeeds& needs, AssemblyConfig imu,
                           bool is_one_step)
    : arrays_(arrays),
      is_one_step_(is_one_step),
      map_(arrays, "signals"),
      imu_(std::move(imu)),
      time_(column("time", 0)),
      derives_(is_derived(arrays, needs, imu_)) {
  position_ = column("position", joint_count, needs.position);
  velocity_ = column("velocity", joint_count, needs.velocity);
  torque_ = column("torque", joint_count, needs.torque);
  linear_acceleration_ = column("linear_acceleration", 3, needs.acceleration_vector || derives_);
  angular_velocity_ = column("angular_velocity", 3, needs.angular_velocity);
  orientation_ = column("orientation", 4, derives_);
  if (!derives_) {
    vertical_acceleration_ = column("vertical_acceleration", 0, needs.acceleration);
  }
  ground_velocity_command_ = column("ground_velocity_command", 0, needs.command);
  for (std::size_t i = 0; i < target_.size(); ++i) {
    target_[i] = column(target_arrays[i].name, joint_count, false);
  }
  if (!is_one_step) has_record_ = column("has_record", 0, false);
}

Signals SignalArrays::at(std::size_t step) const {
  Signals signals;
  signals.time = time_(step);
  const auto number = [&](const std::optional<StepArray>& array, std::size_t item) {
    return array ? (*array)(step, item) : 0.0;
  };
  for (std::size_t i = 0; i < joint_count; ++i) {
    JointSignals& joint = signals.leg[i / 3].*leg_joints[i % 3];
    joint = {number(position_, i), number(velocity_, i), number(torque_, i)};
  }
  for (std::size_t i = 0; i < 3; ++i) {
    signals.linear_acceleration[static_cast<int>(i)] = number(linear_acceleration_, i);
    signals.angular_velocity[static_cast<int>(i)] = number(angular_velocity_, i);
  }
  signals.vertical_acceleration = number(vertical_acceleration_, 0);
  signals.ground_velocity_command = number(ground_velocity_command_, 0);
  for (std::size_t m = 0; m < target_.size(); ++m) {
    for (std::size_t i = 0; i < joint_count && target_[m]; ++i) {
      signals.target[i / 3].*leg_targets[i % 3].*target_arrays[m].member = (*target_[m])(step, i);
    }
  }
  const auto q = [&](std::size_t i) { return (*orientation_)(step, i); };
  convert_imu(signals,
              orientation_ ? std::optional(std::array{q(0), q(1), q(2), q(3)}) : std::nullopt,
              derives_, imu_);
  return signals;
}

std::optional<double> SignalArrays::period() const {
  constexpr std::size_t most = 1000;
  std::vector<double> times;
  for (std::size_t k = 0; k < std::min(steps(), most); ++k) times.push_back(time_(k));
  return logs::typical_step(times);
}

py::dict arrays_of(std::vector<Signals> steps) {
  // Six joints at equal distances, so that one array can view them all.
  static_assert(sizeof(LegSignals) == 3 * sizeof(JointSignals));
  SharedRows<Signals> rows(std::move(steps));
  Signals& first = rows.front();
  JointSignals& joint = first.leg[0].hip;
  py::dict arrays;
  arrays["time"] = rows.view(&first.time);
  arrays["position"] = rows.view(&joint.position, joint_count, sizeof(JointSignals));
  arrays["velocity"] = rows.view(&joint.velocity, joint_count, sizeof(JointSignals));
  arrays["torque"] = rows.view(&joint.torque, joint_count, sizeof(JointSignals));
  arrays["linear_acceleration"] = rows.view(first.linear_acceleration.data(), 3);
  arrays["angular_velocity"] = rows.view(first.angular_velocity.data(), 3);
  arrays["vertical_acceleration"] = rows.view(&first.vertical_acceleration);
  arrays["ground_velocity_command"] = rows.view(&first.ground_velocity_command);
  static_assert(sizeof(LegTargets) == 3 * sizeof(JointTarget));
  JointTarget& target = first.target[0].hip;
  for (const auto& [name, member] : target_arrays) {
    arrays[name] = rows.view(&(target.*member), joint_count, sizeof(JointTarget));
  }
  return arrays;
}

}  // namespace touchdown::python
