#include "simulators/options.hpp"

#include "core/fields.hpp"

namespace touchdown::simulators {

static void describe(Fields& fields, ContactModel& contact) {
  fields("solref_time_constant", contact.solref_time_constant, 1e-4, 1.0);
  fields("solref_damping_ratio", contact.solref_damping_ratio, 0.01, 10.0);
  fields("bullet_stiffness", contact.bullet_stiffness, 1.0, 1e9);
  fields("bullet_damping", contact.bullet_damping, 0.0, 1e9);
  fields("rolling_resistance", contact.rolling_resistance, 0.0, 1.0);
}

void describe(Fields& fields, SimulatorOptions& options) {
  fields("physics_step_us", options.steps.physics_us, 10, 20'000);
  fields("control_step_us", options.steps.control_us, 10, 100'000);
  fields.check(options.steps.control_us % options.steps.physics_us == 0, "control_step_us",
               "expected a multiple of physics_step_us");
  fields.section("contact", options.contact);
}

}  // namespace touchdown::simulators
