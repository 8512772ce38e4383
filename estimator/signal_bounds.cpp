#include "estimator/signal_bounds.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace touchdown {

namespace {

constexpr std::array<std::string_view, signal_count> names = {
    "left hip position",     "left hip velocity",      "left hip torque",
    "left knee position",    "left knee velocity",     "left knee torque",
    "left wheel position",   "left wheel velocity",    "left wheel torque",
    "right hip position",    "right hip velocity",     "right hip torque",
    "right knee position",   "right knee velocity",    "right knee torque",
    "right wheel position",  "right wheel velocity",   "right wheel torque",
    "acceleration x",        "acceleration y",         "acceleration z",
    "angular velocity x",    "angular velocity y",     "angular velocity z",
    "vertical acceleration", "ground velocity command"};

/// A member from the time to the targets, by its number.
double value_of(const Signals& signals, std::size_t index) noexcept {
  static_assert(sizeof(Signals) == (1 + signal_count) * sizeof(double) + sizeof(Signals::target) +
                                       sizeof(Signals::up));
  double value = 0.0;
  // Eigen's vectors have constructors of their own, but nothing besides their numbers.
  const auto* const bytes = reinterpret_cast<const char*>(&signals);  // NOLINT
  std::memcpy(&value, bytes + sizeof(signals.time) + index * sizeof(value), sizeof(value));
  return value;
}

/// Written so that NaN fails.
bool is_within(double value, double largest) noexcept { return std::abs(value) <= largest; }

}  // namespace

std::string_view to_text(SignalIndex signal) noexcept {
  const int index = static_cast<int>(signal);
  return index < 0 || index >= static_cast<int>(signal_count)
             ? std::string_view()
             : names[static_cast<std::size_t>(index)];
}

SignalCheck::SignalCheck(const SignalBounds& bounds) {
  check_members(bounds);
  std::size_t at = 0;
  for (std::size_t joint = 0; joint < 6; ++joint) {
    largest_[at++] = joint % 3 == 2 ? bounds.wheel_position : bounds.leg_position;
    largest_[at++] = bounds.velocity;
    largest_[at++] = bounds.torque;
  }
  for (std::size_t axis = 0; axis < 3; ++axis) largest_[at++] = bounds.acceleration;
  for (std::size_t axis = 0; axis < 3; ++axis) largest_[at++] = bounds.angular_velocity;
  largest_[at++] = bounds.acceleration;
  largest_[at] = bounds.ground_velocity;
}

SignalIndex SignalCheck::first_unusable(const Signals& signals) const noexcept {
  // Without a copy of the values, which would be stored in other pieces than it is loaded.
  std::int64_t usable = 1;  // as wide as the values, so that the loop vectorises
  for (std::size_t i = 0; i < signal_count; ++i) {
    usable &= is_within(value_of(signals, i), largest_[i]) ? 1 : 0;
  }
  if (usable != 0) return SignalIndex::none;
  std::size_t first = 0;
  while (is_within(value_of(signals, first), largest_[first])) ++first;
  return static_cast<SignalIndex>(first);
}

Signals SignalCheck::without_unusable(const Signals& signals,
                                      std::uint32_t stopped) const noexcept {
  constexpr std::uint32_t acceleration = 7U << 18U;
  if ((stopped & acceleration) != 0) stopped |= 1U << 24U;
  std::array<double, signal_count> values{};
  for (std::size_t i = 0; i < signal_count; ++i) {
    const double value = value_of(signals, i);
    const bool usable = is_within(value, largest_[i]) && (stopped >> i & 1U) == 0;
    values[i] = usable ? value : std::numeric_limits<double>::quiet_NaN();
  }
  Signals usable;
  usable.time = signals.time;
  const auto joint = [&](std::size_t i) -> JointSignals {
    return {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
  };
  for (std::size_t side = 0; side < 2; ++side) {
    usable.leg[side] = {joint(3 * side), joint(3 * side + 1), joint(3 * side + 2)};
  }
  usable.linear_acceleration = {values[18], values[19], values[20]};
  usable.angular_velocity = {values[21], values[22], values[23]};
  usable.vertical_acceleration = values[24];
  usable.ground_velocity_command = values[25];
  usable.target = signals.target;
  usable.up = signals.up;
  return usable;
}

}  // namespace touchdown
