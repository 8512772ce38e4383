#include "estimator/force/leg_geometry.hpp"

#include <cmath>

namespace touchdown {

double vertical_force(const LegGeometry& geometry, const LegSignals& leg, bool mirrored,
                      double acceleration) noexcept {
  constexpr double gravity = 9.81;
  const double sign = mirrored ? -1.0 : 1.0;
  const double hip = sign * leg.hip.position;
  const double knee = hip + sign * leg.knee.position;
  // Where the foot goes with each joint: ∂x/∂q, ∂z/∂q.
  const double upper_x = geometry.upper_length * std::cos(hip);
  const double upper_z = geometry.upper_length * std::sin(hip);
  const double lower_x = geometry.lower_length * std::cos(knee);
  const double lower_z = geometry.lower_length * std::sin(knee);
  // What the links and the wheel weigh on each joint, by their arms.
  const double below_knee = geometry.lower_centre * geometry.lower_mass + geometry.wheel_mass;
  const double on_knee = below_knee * lower_z;
  const double on_hip =
      (geometry.upper_centre * geometry.upper_mass + geometry.lower_mass + geometry.wheel_mass) *
          upper_z +
      on_knee;
  const double hip_load = -sign * leg.hip.torque + on_hip * (gravity + acceleration);
  const double knee_load = -sign * leg.knee.torque + on_knee * (gravity + acceleration);
  const double determinant = upper_x * lower_z - lower_x * upper_z;
  return ((upper_x + lower_x) * knee_load - lower_x * hip_load) / determinant;
}

double axle_velocity(const LegGeometry& geometry, const LegSignals& leg) noexcept {
  const double hip = leg.hip.position;
  const double knee = hip + leg.knee.position;
  return geometry.upper_length * std::sin(hip) * leg.hip.velocity +
         geometry.lower_length * std::sin(knee) * (leg.hip.velocity + leg.knee.velocity);
}

}  // namespace touchdown
