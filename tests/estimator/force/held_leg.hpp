#pragma once

#include <array>
#include <cmath>

#include "estimator/force/leg_geometry.hpp"

namespace touchdown::test {

inline constexpr double gravity = 9.81;

/// Heights of the centres of mass of upper leg, lower leg and wheel, and the foot's position, with
/// the hip at the origin (m).
struct LegPositions {
  std::array<double, 3> height;
  double x = 0.0;
  double z = 0.0;
};

inline LegPositions leg_positions(const LegGeometry& leg, double hip, double knee) {
  const double bent = hip + knee;
  const double knee_z = -leg.upper_length * std::cos(hip);
  const double x = leg.upper_length * std::sin(hip) + leg.lower_length * std::sin(bent);
  const double z = knee_z - leg.lower_length * std::cos(bent);
  return {{leg.upper_centre * knee_z, knee_z + leg.lower_centre * (z - knee_z), z}, x, z};
}

/// The torques that hold a leg against a force on its foot while all of it accelerates, by the
/// principle of virtual work: differences of positions, no Jacobian.
inline LegSignals holding(const LegGeometry& leg, double hip, double knee, double force_x,
                          double force_z, double acceleration) {
  constexpr double step = 1e-6;
  const std::array<double, 3> mass = {leg.upper_mass, leg.lower_mass, leg.wheel_mass};
  const auto torque = [&](double along_hip, double along_knee) {
    const LegPositions up = leg_positions(leg, hip + along_hip, knee + along_knee);
    const LegPositions down = leg_positions(leg, hip - along_hip, knee - along_knee);
    double work = force_x * (up.x - down.x) + force_z * (up.z - down.z);
    for (std::size_t i = 0; i < mass.size(); ++i) {
      work -= mass[i] * (gravity + acceleration) * (up.height[i] - down.height[i]);
    }
    return -work / (2.0 * step);
  };
  LegSignals signals;
  signals.hip = {hip, 0.0, torque(step, 0.0)};
  signals.knee = {knee, 0.0, torque(0.0, step)};
  return signals;
}

inline LegSignals mirrored(LegSignals leg) {
  for (JointSignals* joint : {&leg.hip, &leg.knee, &leg.wheel}) {
    joint->position = -joint->position;
    joint->velocity = -joint->velocity;
    joint->torque = -joint->torque;
  }
  return leg;
}

}  // namespace touchdown::test
