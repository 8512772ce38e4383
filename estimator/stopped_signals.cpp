#include "estimator/stopped_signals.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <numbers>

namespace touchdown {

namespace {

constexpr std::size_t joint_values = 18;  // position, velocity and torque of each; then the IMU's
/// Of a joint that reports motion by its position or by its velocity, but not by the other (rad/s).
/// Servos report velocities in steps of up to 0.1 turns/s.
constexpr double least_speed = 0.35;
/// Between two comparisons (rad): one wrong value of the other is no motion.
constexpr double largest_part = 0.04;
/// Resting multiples of a resolution were near each other before.
constexpr double largest_jump = 8.0;  // steps
/// That shows the noise of a torque (s).
constexpr double least_history = 0.5;

/// A wheel's position may be reported within one turn.
double within_turn(double angle) noexcept { return std::remainder(angle, 2.0 * std::numbers::pi); }

/// Among torques, accelerations and angular velocities.
std::size_t noisy_index(std::size_t signal) noexcept {
  return signal < joint_values ? signal / 3 : signal - 12;
}

bool is_in(std::uint32_t bits, std::size_t signal) noexcept { return (bits >> signal & 1U) != 0; }

}  // namespace

void StoppedSignals::start(const Values& values) noexcept {
  first_ = last_ = before_ = earlier_ = values;
  start_time_ = time_;
  step_.fill(std::numeric_limits<double>::infinity());
  largest_ = reversals_ = {};
  longest_ = {};
  compared_ = 0.0;
  changed_ = repeating_ = stopped_ = 0;
}

void StoppedSignals::compare(const Signals& signals, double elapsed) noexcept {
  static_assert(sizeof(signals.time) + sizeof(Values) == offsetof(Signals, vertical_acceleration));
  Values values;
  // Eigen's vectors have constructors of their own, but nothing besides their numbers.
  const auto* const bytes = reinterpret_cast<const char*>(&signals);  // NOLINT
  std::memcpy(values.data(), bytes + sizeof(signals.time), sizeof(values));
  const bool starts = elapsed < 0.0 || time_ == -never;
  time_ = signals.time;
  if (starts) return start(values);
  std::uint32_t equal = 0;
  std::uint32_t differ = 0;  // NaN does neither
  for (std::size_t i = 0; i < count; ++i) {
    equal |= (values[i] == last_[i] ? 1U : 0U) << i;
    differ |= (std::abs(values[i] - last_[i]) > 0.0 ? 1U : 0U) << i;
  }
  const auto noisy = [](const Values& all) {
    return Noisy{all[2],  all[5],  all[8],  all[11], all[14], all[17],
                 all[18], all[19], all[20], all[21], all[22], all[23]};
  };
  const Noisy now = noisy(values);
  const Noisy last = noisy(last_);
  const Noisy before = noisy(before_);
  for (std::size_t i = 0; i < now.size(); ++i) {
    const double size = std::abs(now[i]);
    largest_[i] = size > largest_[i] ? size : largest_[i];
    const double change = std::abs(now[i] - last[i]);
    const double some = change > 0.0 ? change : never;
    step_[i] = some < step_[i] ? some : step_[i];
    const double product = (now[i] - last[i]) * (last[i] - before[i]);
    reversals_[i] += product < -4.0 * step_[i] * step_[i] ? 1.0 : 0.0;
  }
  compared_ += 1.0;
  for (std::size_t i = 0; i < count && (differ & ~changed_) >> i != 0; ++i) {
    if (is_in(differ & ~changed_, i)) left_[i] = time_ - elapsed;
  }
  changed_ |= differ;
  // Nothing is known of a gap's time: repetitions begin after it.
  if (elapsed > 0.25 * after_) repeating_ = equal = 0;
  const std::uint32_t followed = (equal | repeating_) & changed_;
  for (std::size_t i = 0; i < count && followed >> i != 0; ++i) {
    if (!is_in(followed, i)) continue;
    if (is_in(equal, i)) {
      follow(i, values, elapsed);
    } else if (const double held = time_ - elapsed - since_[i];
               held > longest_[i] && !is_in(stopped_, i)) {
      longest_[i] = held;
    }
  }
  repeating_ = equal & changed_;
  earlier_ = before_;
  before_ = last_;
  last_ = values;
  std::uint32_t stopped = 0;
  for (std::size_t i = 0; i < count && repeating_ >> i != 0; ++i) {
    if (!is_in(repeating_, i) || time_ - since_[i] < after_) continue;
    if (is_in(stopped_, i) || has_stopped(i)) stopped |= 1U << i;
  }
  stopped_ = stopped;
}

/// Takes the next value of a signal that repeats itself.
void StoppedSignals::follow(std::size_t i, const Values& values, double elapsed) noexcept {
  const bool is_position = i < joint_values && i % 3 == 0;
  const bool is_velocity = i < joint_values && i % 3 == 1;
  if (!is_in(repeating_, i)) {
    since_[i] = time_ - elapsed;
    const bool was_constant = left_[i] - start_time_ >= after_;
    if (was_constant && values[i] == first_[i] && since_[i] - left_[i] < after_) {
      changed_ &= ~(1U << i);
    }
    const double change = last_[i] - before_[i];
    // A dead signal may jump to 0; one that comes back from a wrong value jumps, too.
    const bool is_jump = std::abs(before_[i] - earlier_[i]) < 0.5 * std::abs(change);
    jump_[i] = is_jump ? change : 0.0;
    travel_[i] = is_jump && is_position ? elapsed * last_[i + 1] - change : 0.0;
  }
  const double moved = is_position   ? elapsed * values[i + 1]
                       : is_velocity ? values[i - 1] - last_[i - 1] - elapsed * values[i]
                                     : 0.0;
  travel_[i] += std::clamp(within_turn(moved), -largest_part, largest_part);
}

/// Whether a signal is a multiple of a resolution that did not jump, and larger than its noise.
bool StoppedSignals::rests_on_a_step(std::size_t i) const noexcept {
  constexpr double rounding = 0.01;
  constexpr double share_of_noise = 0.1;
  const std::size_t k = noisy_index(i);
  const auto is_multiple = [&](double value) {
    return !(std::abs(std::remainder(value / step_[k], 1.0)) >= rounding);  // NaN: unknown
  };
  return is_multiple(last_[i]) && is_multiple(jump_[i]) && is_multiple(largest_[k]) &&
         !(std::abs(jump_[i]) >= largest_jump * step_[k]) &&
         reversals_[k] < share_of_noise * compared_;
}

bool StoppedSignals::has_stopped(std::size_t i) const noexcept {
  const double held = time_ - since_[i];
  if (i < joint_values && i % 3 != 2) {
    return std::abs(within_turn(travel_[i])) > least_speed * held;
  }
  if (held < 4.0 * longest_[i] || std::abs(last_[i]) >= largest_[noisy_index(i)] ||
      rests_on_a_step(i))
    return false;
  const auto moves = [&](std::size_t other) {
    return !is_in(repeating_, other) && is_in(changed_, other) && std::isfinite(last_[other]);
  };
  if (i < joint_values && (moves(i - 1) || moves(i - 2))) return true;
  bool any = false;
  for (std::size_t k = i < joint_values ? 0 : joint_values; k < count; ++k) any = any || moves(k);
  // A leg that stands still has a torque of some noise, if it had one before.
  return any && longest_[i] <= 0.5 * after_ && since_[i] >= start_time_ + least_history;
}

}  // namespace touchdown
