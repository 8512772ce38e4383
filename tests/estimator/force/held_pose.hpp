#pragma once

#include <array>

#include <gtest/gtest.h>

#include "estimator/contact_estimator.hpp"
#include "estimator/force/leg_geometry.hpp"
#include "tests/estimator/force/held_leg.hpp"
#include "tests/estimator/random.hpp"

namespace touchdown::test {

inline constexpr double position_gain = 40.0;  // N·m/rad

/// A robot that holds its legs in one pose.
struct HeldPose {
  double hip = 0.455;
  double knee = -0.791;
  double left = 26.0;   ///< force on the wheel (N)
  double right = 26.0;  ///< likewise
  double acceleration = 0.0;
  double torque_noise = 0.001;  ///< of the sensors (N·m); never zero, so that none is frozen
  /// The shares of it that hips, knees and wheels have.
  std::array<double, 3> noisy = {1.0, 1.0, 1.0};
  bool has_targets = false;
};

/// Targets that make the servos apply these torques.
inline LegTargets targets_of(const LegSignals& leg) {
  const auto of = [](const JointSignals& joint) {
    return JointTarget{joint.position + joint.torque / position_gain, 0.0, 0.0, position_gain, 1.0};
  };
  return {of(leg.hip), of(leg.knee), of(leg.wheel)};
}

/// The belief after these steps of one millisecond.
inline Belief held(ContactEstimator& estimator, const HeldPose& pose, int steps = 1000) {
  Normal normal(1);
  Signals signals;
  Belief belief;
  for (int k = 0; k < steps; ++k) {
    signals.time += 0.001;
    signals.vertical_acceleration = pose.acceleration + 1e-6 * normal();
    signals.angular_velocity.x() = 1e-6 * normal();
    signals.leg[0] = holding({}, pose.hip, pose.knee, 0.0, pose.left, pose.acceleration);
    signals.leg[1] = mirrored(holding({}, pose.hip, pose.knee, 0.0, pose.right, pose.acceleration));
    for (std::size_t i = 0; i < 2; ++i) {
      LegSignals& leg = signals.leg[i];
      if (pose.has_targets) signals.target[i] = targets_of(leg);
      const std::array<JointSignals*, 3> joints = {&leg.hip, &leg.knee, &leg.wheel};
      for (std::size_t j = 0; j < joints.size(); ++j) {
        joints[j]->torque += pose.torque_noise * pose.noisy[j] * normal();
      }
    }
    belief = estimator.update(signals);
  }
  return belief;
}

/// The loads that an estimator reports at the end.
template <typename Estimator>
std::array<WheelLoad, 2> held_loads(const HeldPose& pose) {
  Estimator estimator;
  const Belief belief = held(estimator, pose);
  return {belief.wheel[0].load, belief.wheel[1].load};
}

inline void expect_within_two_deviations(const WheelLoad& load, double force) {
  EXPECT_LE(std::abs(load.force - force), 2.0 * load.deviation);
  EXPECT_LT(load.deviation, 0.25 * 9.81 * LegGeometry{}.robot_mass);
}

}  // namespace touchdown::test
