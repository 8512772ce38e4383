#include "policies/crouching.hpp"

#include "core/fields.hpp"
#include "policies/script.hpp"

namespace touchdown::policies {

const CrouchCommand* crouch_at(const CrouchScript& script, double time) {
  return in_force(script, time);
}

void describe(Fields& fields, CrouchCommand& command, const CrouchScript& script) {
  fields("time", command.time, 0.0, 1e6).doc("s", "Start of the command.");
  fields.require("hip", command.hip, -largest_angle, largest_angle)
      .doc("rad", "Hip angle, forward positive; 0: straight legs. The knee follows.");
  fields("rate", command.rate, 1e-3, 100.0).doc("rad/s", "Rate of the hip angle.");
  check_order(fields, command, script);
}

}  // namespace touchdown::policies
