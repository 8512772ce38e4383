#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "estimator/labelled_run.hpp"
#include "tests/estimator/force/held_leg.hpp"

namespace touchdown::test {

/// Steps of one millisecond of a crouching robot with given loads on its wheels.
struct CarriedRun {
  std::vector<Signals> signals;
  std::array<std::vector<std::uint8_t>, 2> contact;

  /// Adds a step with these loads (N). The caller may change the rest of it.
  Signals& add(double left, double right, double acceleration = 0.0) {
    Signals s;
    const auto k = static_cast<double>(signals.size());
    s.time = 0.001 * (k + 1.0);
    s.vertical_acceleration = acceleration + 1e-9 * static_cast<double>(signals.size() % 2);
    s.leg[0] = holding({}, 0.455, -0.791, 0.0, left, acceleration);
    s.leg[1] = mirrored(holding({}, 0.455, -0.791, 0.0, right, acceleration));
    signals.push_back(s);
    for (auto& wheel : contact) wheel.push_back(0);
    return signals.back();
  }
  /// Sets whether the wheels are in contact at the last step.
  void label(bool left, bool right) {
    contact[0].back() = left ? 1 : 0;
    contact[1].back() = right ? 1 : 0;
  }
  [[nodiscard]] LabelledRun view() const { return {signals, {contact[0], contact[1]}}; }
};

/// The signals of the robot mirrored at its middle plane.
inline Signals in_the_mirror(Signals s) {
  std::swap(s.leg[0], s.leg[1]);
  for (LegSignals& leg : s.leg) leg = mirrored(leg);
  s.angular_velocity.x() *= -1.0;
  return s;
}

}  // namespace touchdown::test
