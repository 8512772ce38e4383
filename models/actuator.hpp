#pragma once

#include <limits>

namespace touchdown {
class Fields;
}

namespace touchdown::models {

/// What stands between a servo's law and its joint. The default is the ideal actuator: the joint
/// feels what the law says, at once, and the servo reports just that.
///
///     τ* = law(command of `command_delay` ago, q, q̇), within ± the smaller of the joint's limits
///     τ_lag·dτ/dt = τ* − τ                        what the servo believes it does, and reports
///     joint feels (1 + torque_error)·τ + ripple·sin(ripple_cycles·q) − friction(q) − viscous·q̇
///
/// friction(q) is Coulomb's with stiction: an elastic, critically damped presliding of
/// `presliding_stiffness` that slides once it holds ± `friction`, so that a joint at rest stays
/// where it is under any smaller torque, without creeping.
struct Actuator {
  double friction = 0.0;              ///< Coulomb friction (N·m)
  double presliding_stiffness = 400;  ///< of the joint while it sticks (N·m/rad)
  double viscous = 0.0;               ///< viscous friction (N·m·s/rad)
  double armature = 0.0;       ///< rotor inertia seen at the joint, gear² × rotor (kg·m²)
  double torque_lag = 0.0;     ///< time constant of the torque (s)
  double command_delay = 0.0;  ///< from the policy to the servo, in whole control steps (s)
  double maximum_torque = std::numeric_limits<double>::infinity();  ///< saturation (N·m)
  double ripple = 0.0;                                              ///< amplitude (N·m)
  double ripple_cycles = 1.0;                                       ///< per radian of the joint
  double torque_error = 0.0;  ///< relative error of the torque constant that the servo believes in

  /// The joint feels what the servo's law says.
  bool is_ideal() const {
    return friction == 0.0 && viscous == 0.0 && torque_lag == 0.0 && command_delay == 0.0 &&
           ripple == 0.0 && torque_error == 0.0;
  }
};

/// Keys are the members' names.
void describe(Fields& fields, Actuator& actuator);

}  // namespace touchdown::models
