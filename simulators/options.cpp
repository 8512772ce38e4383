#include "simulators/options.hpp"

#include "core/fields.hpp"

namespace touchdown::simulators {

static void describe(Fields& fields, ContactModel& contact) {
  fields("solref_time_constant", contact.solref_time_constant, 1e-4, 1.0)
      .doc("s", "Time constant of MuJoCo's contact spring.");
  fields("solref_damping_ratio", contact.solref_damping_ratio, 0.01, 10.0)
      .doc("Damping ratio of MuJoCo's contact spring.");
  fields("bullet_stiffness", contact.bullet_stiffness, 1.0, 1e9)
      .doc("N/m", "Stiffness of the tyres in Bullet.");
  fields("bullet_damping", contact.bullet_damping, 0.0, 1e9)
      .doc("N·s/m", "Damping of the tyres in Bullet.");
  fields("bullet_edge_radius", contact.bullet_edge_radius, 0.0, 0.04)
      .doc("m", "Radius of the edges of boxes in Bullet; its own default is 0.04.");
  fields("rolling_resistance", contact.rolling_resistance, 0.0, 1.0)
      .doc("m", "Torque against rolling per newton of load.");
}

void describe(Fields& fields, SimulatorOptions& options) {
  fields("physics_step_us", options.steps.physics_us, 10, 20'000)
      .doc("µs", "Step of the physics engine; a stiff tyre shortens it.");
  fields("control_step_us", options.steps.control_us, 10, 100'000)
      .doc("µs", "Period of the control loop, a multiple of the physics step.");
  fields.check(options.steps.control_us % options.steps.physics_us == 0, "control_step_us",
               "expected a multiple of physics_step_us");
  fields.section("contact", options.contact).doc("Contact between tyres and ground.");
}

}  // namespace touchdown::simulators
