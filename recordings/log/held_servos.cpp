#include "recordings/log/held_servos.hpp"

#include <algorithm>
#include <limits>

#include "estimator/signal_guard.hpp"

namespace touchdown::recordings {

namespace {

/// As long as estimators bridge a gap (s), and a rounding error of the clock.
constexpr double longest_hold = SignalGuardConfig{}.maximum_gap + 1e-6;

double time_of(const LogValues& values, const LogPresence& present) {
  return values[present[log_slot::time] ? log_slot::time : log_slot::wall_time];
}

}  // namespace

HeldServos::HeldServos() {
  for (const LogKey& key : log_keys()) {
    if (key.role != LogKey::Role::needed) continue;
    for (std::size_t i = 0; i < key.size; ++i) needed_.set(key.slot + i);
  }
}

bool HeldServos::complete(LogValues& values, LogPresence& present) {
  if (!is_started_) return false;
  if (!present[log_slot::time] && !present[log_slot::wall_time]) return false;
  const LogPresence missing = needed_ & ~present;
  std::size_t of_servos = 0;
  for (std::size_t i = 0; i < count; ++i) of_servos += missing[log_slot::servo + i] ? 1 : 0;
  if (of_servos != missing.count() || 2 * of_servos > count) return false;
  const double now = time_of(values, present);
  double oldest = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t slot = log_slot::servo + i;
    if (!missing[slot]) {
      value_[i] = values[slot];
      time_[i] = now;
      continue;
    }
    const double age = now - time_[i];
    const bool is_held = age >= 0.0 && age <= longest_hold;
    values[slot] = is_held ? value_[i] : std::numeric_limits<double>::quiet_NaN();
    present.set(slot);
    oldest = is_held ? std::max(oldest, age) : std::numeric_limits<double>::infinity();
  }
  if (oldest > longest_hold) {
    ++lost_;
  } else {
    ++records_;
    oldest_ = std::max(oldest_, oldest);
  }
  return true;
}

void HeldServos::remember(const LogValues& values, const LogPresence& present) {
  is_started_ = true;
  std::copy_n(values.begin() + log_slot::servo, count, value_.begin());
  time_.fill(time_of(values, present));
}

}  // namespace touchdown::recordings
