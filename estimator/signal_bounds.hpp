#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "estimator/members.hpp"
#include "estimator/signals.hpp"

namespace touchdown {

/// The largest absolute values that a robot's sensors can report. The defaults are far beyond any
/// wheeled biped: a larger value is a fault of a sensor, a bus or a conversion.
struct SignalBounds {
  double leg_position = 1e3;      ///< of hips and knees, turns included (rad)
  double wheel_position = 1e9;    ///< of wheels, which turn without end (rad)
  double velocity = 1e3;          ///< of joints (rad/s)
  double torque = 1e4;            ///< of joints (N·m)
  double acceleration = 1e4;      ///< of the IMU, each axis and the vertical (m/s²)
  double angular_velocity = 1e3;  ///< of the IMU, each axis (rad/s)
  double ground_velocity = 1e3;   ///< commanded (m/s)

  bool operator==(const SignalBounds&) const = default;
};

void members(auto& visit, MembersOf<SignalBounds> auto& bounds) {
  visit("bounds.leg_position", bounds.leg_position, Range::positive);
  visit("bounds.wheel_position", bounds.wheel_position, Range::positive);
  visit("bounds.velocity", bounds.velocity, Range::positive);
  visit("bounds.torque", bounds.torque, Range::positive);
  visit("bounds.acceleration", bounds.acceleration, Range::positive);
  visit("bounds.angular_velocity", bounds.angular_velocity, Range::positive);
  visit("bounds.ground_velocity", bounds.ground_velocity, Range::positive);
}

/// The number of a member of `Signals` after the time, in their order, without the optional
/// targets.
enum class SignalIndex : int { none = -1 };
inline constexpr std::size_t signal_count = 26;

/// "left hip position", "vertical acceleration", …; empty for `none`.
std::string_view to_text(SignalIndex signal) noexcept;

/// Checks every signal of a step against its bound. Targets pass unchecked, because a missing one
/// is no fault; `servo_torque` checks them.
class SignalCheck {
 public:
  /// Errors: as `check_members`.
  explicit SignalCheck(const SignalBounds& bounds = {});

  /// The first signal that is NaN or beyond its bound; `none` if all are usable.
  [[nodiscard]] SignalIndex first_unusable(const Signals& signals) const noexcept;

  /// The same signals with NaN in place of every value beyond its bound, and of the `stopped` ones,
  /// one bit each by `SignalIndex`. The vertical acceleration follows from all three axes.
  [[nodiscard]] Signals without_unusable(const Signals& signals,
                                         std::uint32_t stopped = 0) const noexcept;

 private:
  std::array<double, signal_count> largest_;
};

}  // namespace touchdown
