#include "policies/crouching.hpp"

#include "core/fields.hpp"
#include "policies/script.hpp"

namespace touchdown::policies {

const CrouchCommand* crouch_at(const CrouchScript& script, double time) {
  return in_force(script, time);
}

void describe(Fields& fields, CrouchCommand& command, const CrouchScript& script) {
  fields("time", command.time, 0.0, 1e6);
  fields.require("hip", command.hip, -1.26, 1.26);
  fields("rate", command.rate, 1e-3, 100.0);
  check_order(fields, command, script);
}

}  // namespace touchdown::policies
