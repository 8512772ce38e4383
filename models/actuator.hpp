#pragma once

#include <limits>

namespace touchdown {
class Fields;
}

namespace touchdown::models {

/// Actuator model between a servo's control law and its joint. The default is the ideal actuator:
/// the torque of the law acts on the joint without delay, and the servo reports it.
///
///     τ* = law(command of `command_delay` ago, q, q̇), within ± the smaller of the joint's limits
///     τ_lag·dτ/dt = τ* − τ                        the torque that the servo estimates and reports
///     joint torque = (1 + torque_error)·τ + ripple·sin(ripple_cycles·q) − friction(q) − viscous·q̇
///
/// With `backlash`, the rotor (`armature`) crosses the play under the motor's torque, and the joint
/// has none meanwhile. Position and velocity of the servo's law, and those that it reports, are the
/// rotor's. The rotor comes to rest at the flank.
///
/// friction(q) is Coulomb friction with stiction, of `friction` + `load_friction`·|τ|, because
/// gears lose a share of what they transmit. Presliding is elastic and critically damped, with
/// `presliding_stiffness`; the joint slides once it holds that much. A joint at rest does not
/// creep under any smaller torque.
struct Actuator {
  double friction = 0.0;              ///< Coulomb friction (N·m)
  double load_friction = 0.0;         ///< of the torque, a share that gears lose
  double presliding_stiffness = 400;  ///< of the joint while it sticks (N·m/rad)
  double viscous = 0.0;               ///< viscous friction (N·m·s/rad)
  double armature = 0.0;       ///< rotor inertia seen at the joint, gear² × rotor (kg·m²)
  double backlash = 0.0;       ///< play of the gears at the joint (rad)
  double torque_lag = 0.0;     ///< time constant of the torque (s)
  double command_delay = 0.0;  ///< from the policy to the servo, in whole control steps (s)
  double maximum_torque = std::numeric_limits<double>::infinity();  ///< saturation (N·m)
  double ripple = 0.0;                                              ///< amplitude (N·m)
  double ripple_cycles = 1.0;                                       ///< per radian of the joint
  double torque_error = 0.0;  ///< relative error of the servo's torque constant
  /// Whether the torque of the servo's law acts on the joint unchanged.
  bool is_ideal() const {
    return friction == 0.0 && load_friction == 0.0 && viscous == 0.0 && torque_lag == 0.0 &&
           command_delay == 0.0 && ripple == 0.0 && torque_error == 0.0 && backlash == 0.0;
  }
};

/// The keys are the names of the members.
void describe(Fields& fields, Actuator& actuator);

}  // namespace touchdown::models
