#include "models/actuator.hpp"

#include <cmath>

#include "core/fields.hpp"

namespace touchdown::models {

void describe(Fields& fields, Actuator& actuator) {
  fields("friction", actuator.friction, 0.0, 100.0).doc("N·m", "Coulomb friction, with stiction.");
  fields("load_friction", actuator.load_friction, 0.0, 0.9)
      .doc("Share of the torque that gears lose: friction that grows with the load.");
  fields("presliding_stiffness", actuator.presliding_stiffness, 1.0, 1e5)
      .doc("N·m/rad", "Stiffness of the joint while it sticks.");
  fields("viscous", actuator.viscous, 0.0, 10.0).doc("N·m·s/rad", "Viscous friction.");
  fields("armature", actuator.armature, 0.0, 1.0)
      .doc("kg·m²", "Inertia of the rotor at the joint: gear ratio squared times the rotor's.");
  fields("backlash", actuator.backlash, 0.0, 0.5)
      .doc("rad", "Play of the gears at the joint. The servo reports its rotor's side.");
  fields("torque_lag", actuator.torque_lag, 0.0, 1.0).doc("s", "Time constant of the torque.");
  fields("command_delay", actuator.command_delay, 0.0, 1.0)
      .doc("s", "Delay from the policy to the servo, in whole control steps.");
  fields
      .if_set(std::isfinite(actuator.maximum_torque), "maximum_torque", actuator.maximum_torque,
              0.0, 1e3)
      .doc("N·m", "Saturation of the torque, besides the limit of the MJCF.");
  fields("ripple", actuator.ripple, 0.0, 100.0).doc("N·m", "Amplitude of the torque ripple.");
  fields("ripple_cycles", actuator.ripple_cycles, 0.0, 1e3)
      .doc("1/rad", "Frequency of the ripple, as the factor on the joint angle in its sine.");
  fields("torque_error", actuator.torque_error, -0.9, 10.0)
      .doc("Relative error of the servo's torque constant.");
}

}  // namespace touchdown::models
