#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "estimator/signals.hpp"

namespace touchdown {

/// Notices signals of joints and IMU that stop within a run: they repeat themselves to the bit
/// although the robot moves. These are no faults:
/// - a signal that never changed but for wrong values, because the robot may lack it;
/// - a position that repeats itself while its velocity integrates to little, and the other way
///   round; a torque or an axis of the IMU while no other signal changes: a simulation at rest;
/// - a torque at its limit, or an IMU at the end of its range: the largest value so far;
/// - multiples of a resolution, where small motions rest, unless the last change was a jump or the
///   noise is larger;
/// - a torque or axis that repeated itself for a quarter as long before: held, or often at rest.
class StoppedSignals {
 public:
  /// `after`: how long a signal repeats itself before it counts as stopped (s); 0 = never.
  explicit StoppedSignals(double after = 0.25) noexcept
      : after_(after), interval_(after > 0.0 ? after / comparisons : never) {}

  void reset() noexcept { *this = StoppedSignals(after_); }

  /// Takes the next step and returns the stopped signals, one bit each by their number among the
  /// members of `Signals` after the time (`SignalIndex`). Compares with the samples of 12 times
  /// within `after`. A step back in time starts anew.
  std::uint32_t update(const Signals& signals) noexcept {
    const double elapsed = signals.time - time_;
    if (elapsed >= interval_ || elapsed < 0.0) compare(signals, elapsed);  // NaN waits
    return stopped_;
  }

  /// Since when a signal that stopped has repeated itself (s).
  [[nodiscard]] double since(std::size_t signal) const noexcept { return since_[signal]; }
  /// Its value at the last comparison.
  [[nodiscard]] double value(std::size_t signal) const noexcept { return last_[signal]; }

 private:
  static constexpr std::size_t count = 24;  ///< signals of joints and IMU
  using Values = std::array<double, count>;
  using Noisy = std::array<double, 12>;
  static constexpr double comparisons = 12.0;
  static constexpr double never = 1e300;

  void compare(const Signals& signals, double elapsed) noexcept;
  void start(const Values& values) noexcept;
  void follow(std::size_t signal, const Values& values, double elapsed) noexcept;
  [[nodiscard]] bool has_stopped(std::size_t signal) const noexcept;
  [[nodiscard]] bool rests_on_a_step(std::size_t signal) const noexcept;

  double after_;
  double interval_;       ///< between two comparisons (s)
  double time_ = -never;  ///< of the last comparison (s)
  double start_time_ = 0.0;
  std::uint32_t changed_ = 0;    ///< signals that have changed since the start
  std::uint32_t repeating_ = 0;  ///< signals that repeat themselves
  std::uint32_t stopped_ = 0;
  Values last_{};
  Values before_{};        ///< at the comparison before it …
  Values earlier_{};       ///< … and before that
  Values first_{};         ///< at the start
  Values left_{};          ///< when a signal changed from that value (s)
  double compared_ = 0.0;  ///< times since the start
  // Of torques, accelerations and angular velocities:
  Noisy largest_{};    ///< sizes
  Noisy step_{};       ///< the smallest change but none
  Noisy reversals_{};  ///< how often two changes beyond the resolution had opposite signs
  // Of signals that repeat themselves:
  Values since_{};    ///< from when on (s)
  Values jump_{};     ///< the change before that
  Values travel_{};   ///< of a position or velocity: the integral that contradicts it (rad)
  Values longest_{};  ///< the longest repetition that ended by itself (s)
};

}  // namespace touchdown
