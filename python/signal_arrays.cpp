#include "python/signal_arrays.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

#include <fmt/format.h>

#include "core/error.hpp"

namespace touchdown::python {

namespace {

constexpr std::size_t joint_count = 6;

/// Sets hip, knee and wheel of the left leg, then of the right one, to `joint(index)`.
template <typename Joint>
void set_joints(Signals& signals, const Joint& joint) {
  std::size_t index = 0;
  for (LegSignals& leg : signals.leg) {
    leg.hip = joint(index++);
    leg.knee = joint(index++);
    leg.wheel = joint(index++);
  }
}

/// Whether the three arrays view one row of joints with the layout of `Signals`, as those of a
/// recording do. Such rows are copied at once.
bool have_layout_of_signals(const StepArray& position, const StepArray& velocity,
                            const StepArray& torque) {
  static_assert(sizeof(Signals::leg) == joint_count * sizeof(JointSignals));
  const auto is_member = [&](const StepArray& column, std::size_t offset) {
    return column.row(0) == position.row(0) + offset &&
           column.item_bytes() == sizeof(JointSignals) &&
           column.step_bytes() == position.step_bytes();
  };
  return is_member(position, offsetof(JointSignals, position)) &&
         is_member(velocity, offsetof(JointSignals, velocity)) &&
         is_member(torque, offsetof(JointSignals, torque));
}

/// `count` numbers of one step, by name.
StepArray numbers_of(const py::object& step, const char* name, std::size_t count) {
  if (!step.contains(name)) {
    throw InputError(fmt::format("signals: '{}' is missing: expected {}", name,
                                 count == 1 ? "a number" : fmt::format("{} numbers", count)));
  }
  auto array = StepArray::Array::ensure(step[name]);
  if (!array || array.size() != static_cast<py::ssize_t>(count) || array.ndim() > 1) {
    throw InputError(fmt::format("signals: '{}': expected {}", name,
                                 count == 1 ? "a number" : fmt::format("{} numbers", count)));
  }
  return StepArray(StepArray::Array(array.reshape({static_cast<py::ssize_t>(count)})));
}

}  // namespace

SignalArrays::SignalArrays(const py::object& arrays)
    : map_(arrays, "signals"),
      time_(map_.column("time")),
      position_(map_.column("position", joint_count)),
      velocity_(map_.column("velocity", joint_count)),
      torque_(map_.column("torque", joint_count)),
      linear_acceleration_(map_.column("linear_acceleration", 3)),
      angular_velocity_(map_.column("angular_velocity", 3)),
      vertical_acceleration_(map_.column("vertical_acceleration")),
      ground_velocity_command_(map_.column("ground_velocity_command")) {
  if (map_.has("heard")) {
    throw InputError("signals: 'heard' was renamed: expected 'has_record'");
  }
  if (map_.has("has_record")) has_record_.emplace(map_.column("has_record"));
  has_layout_of_signals_ = have_layout_of_signals(position_, velocity_, torque_);
}

Signals SignalArrays::at(std::size_t step) const {
  Signals signals;
  signals.time = time_(step);
  if (has_layout_of_signals_) {
    std::memcpy(signals.leg.data(), position_.row(step), sizeof signals.leg);
  } else {
    set_joints(signals, [&](std::size_t i) {
      return JointSignals{position_(step, i), velocity_(step, i), torque_(step, i)};
    });
  }
  for (std::size_t i = 0; i < 3; ++i) {
    signals.linear_acceleration[static_cast<int>(i)] = linear_acceleration_(step, i);
    signals.angular_velocity[static_cast<int>(i)] = angular_velocity_(step, i);
  }
  signals.vertical_acceleration = vertical_acceleration_(step);
  signals.ground_velocity_command = ground_velocity_command_(step);
  return signals;
}

std::optional<double> SignalArrays::period() const {
  constexpr std::size_t most = 1000;
  std::vector<double> differences;
  for (std::size_t k = 1; k < std::min(steps(), most); ++k) {
    const double difference = time_(k) - time_(k - 1);
    if (std::isfinite(difference)) differences.push_back(difference);
  }
  if (differences.empty()) return std::nullopt;
  const auto middle = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2);
  std::nth_element(differences.begin(), middle, differences.end());
  return *middle;
}

Signals signals_of_step(const py::object& step) {
  Signals signals;
  signals.time = numbers_of(step, "time", 1)(0);
  const StepArray position = numbers_of(step, "position", joint_count);
  const StepArray velocity = numbers_of(step, "velocity", joint_count);
  const StepArray torque = numbers_of(step, "torque", joint_count);
  set_joints(signals, [&](std::size_t i) {
    return JointSignals{position(i), velocity(i), torque(i)};
  });
  const StepArray linear = numbers_of(step, "linear_acceleration", 3);
  const StepArray angular = numbers_of(step, "angular_velocity", 3);
  signals.linear_acceleration = {linear(0), linear(1), linear(2)};
  signals.angular_velocity = {angular(0), angular(1), angular(2)};
  signals.vertical_acceleration = numbers_of(step, "vertical_acceleration", 1)(0);
  signals.ground_velocity_command = numbers_of(step, "ground_velocity_command", 1)(0);
  return signals;
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
  return arrays;
}

}  // namespace touchdown::python
