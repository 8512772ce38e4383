#include "recordings/mapping/row_hold.hpp"

#include <algorithm>
#include <cmath>

#include "estimator/signal_guard.hpp"

namespace touchdown::recordings {

namespace {

/// As long as estimators bridge a gap (s), and a rounding error of the clock.
constexpr double longest_hold = SignalGuardConfig{}.maximum_gap + 1e-6;

}  // namespace

RowHold::RowHold(const LogMapping& mapping) {
  for (const MappedSignal* signal : {&mapping.position, &mapping.velocity, &mapping.torque}) {
    add(*signal, true);
  }
  if (mapping.leg_targets) {
    add(mapping.leg_targets->position, true);
    if (mapping.leg_targets->velocity) add(*mapping.leg_targets->velocity, true);
    if (mapping.leg_targets->torque) add(*mapping.leg_targets->torque, true);
  }
  if (!mapping.clocks.empty()) return;  // the others have sources of their own (SourceJoin)
  add(mapping.orientation, false);
  add(mapping.angular_velocity, false);
  if (mapping.linear_acceleration) add(*mapping.linear_acceleration, false);
  if (mapping.proper_acceleration) add(*mapping.proper_acceleration, false);
}

void RowHold::add(const MappedSignal& signal, bool is_of_joint) {
  for (const MappedSignal::Number& number : signal.numbers) {
    if (number.column != MappedSignal::no_column) held_.push_back({number.column, is_of_joint});
  }
}

bool RowHold::complete(std::span<double> row, double time) {
  bool has_joint = false;
  bool has_other = false;
  bool is_completed = false;
  double oldest = 0.0;
  for (Held& held : held_) {
    double& number = row[held.column];
    if (!std::isnan(number)) {
      (held.is_of_joint ? has_joint : has_other) = true;
      held.value = number;
      held.time = std::isfinite(time) ? time : held.time;
      continue;
    }
    const double age = time - held.time;
    if (!(age >= 0.0 && age <= longest_hold)) continue;
    number = held.value;
    is_completed = true;
    oldest = std::max(oldest, age);
  }
  if (!has_joint && has_other) {
    ++without_joints_;
    return false;
  }
  if (is_completed) {
    ++completed_;
    oldest_ = std::max(oldest_, oldest);
  }
  return true;
}

}  // namespace touchdown::recordings
