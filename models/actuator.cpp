#include "models/actuator.hpp"

#include <cmath>

#include "core/fields.hpp"

namespace touchdown::models {

void describe(Fields& fields, Actuator& actuator) {
  fields("friction", actuator.friction, 0.0, 100.0);
  fields("presliding_stiffness", actuator.presliding_stiffness, 1.0, 1e5);
  fields("viscous", actuator.viscous, 0.0, 10.0);
  fields("armature", actuator.armature, 0.0, 1.0);
  fields("torque_lag", actuator.torque_lag, 0.0, 1.0);
  fields("command_delay", actuator.command_delay, 0.0, 1.0);
  if (fields.reading() || std::isfinite(actuator.maximum_torque)) {
    fields("maximum_torque", actuator.maximum_torque, 0.0, 1e3);
  }
  fields("ripple", actuator.ripple, 0.0, 100.0);
  fields("ripple_cycles", actuator.ripple_cycles, 0.0, 1e3);
  fields("torque_error", actuator.torque_error, -0.9, 10.0);
}

}  // namespace touchdown::models
