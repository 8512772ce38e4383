#include "scenarios/perturbation.hpp"

#include "core/fields.hpp"

namespace touchdown::scenarios {

void describe(Fields& fields, Perturbation& perturbation) {
  fields("x", perturbation.x, 0.0, 10.0);
  fields("y", perturbation.y, 0.0, 10.0);
  fields("yaw", perturbation.yaw, 0.0, 3.2);
  fields("velocity", perturbation.velocity, 0.0, 2.0);
  fields("crouch", perturbation.crouch, 0.0, 1.0);
  fields("mass_scale", perturbation.mass_scale, 0.0, 0.9);
  fields("friction", perturbation.friction, 0.0, 2.0);
  fields("servo_gain_scale", perturbation.servo_gain_scale, 0.0, 0.9);
  fields("force_scale", perturbation.force_scale, 0.0, 1.0);
  fields.section("drive", perturbation.drive);
  fields.section("lift", perturbation.lift);
}

}  // namespace touchdown::scenarios
