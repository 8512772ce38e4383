#include "simulators/options.hpp"

namespace touchdown {

SimulatorOptions simulator_options_from_yaml(YamlMap map) {
  SimulatorOptions options;
  map.read("physics_step_us", options.steps.physics_us, 10, 20'000);
  map.read("control_step_us", options.steps.control_us, 10, 100'000);
  if (options.steps.control_us % options.steps.physics_us != 0) {
    map.fail("control_step_us", "expected a multiple of physics_step_us");
  }
  YamlMap contact = map.child("contact");
  ContactModel& c = options.contact;
  contact.read("solref_time_constant", c.solref_time_constant, 1e-4, 1.0);
  contact.read("solref_damping_ratio", c.solref_damping_ratio, 0.01, 10.0);
  contact.read("bullet_stiffness", c.bullet_stiffness, 1.0, 1e9);
  contact.read("bullet_damping", c.bullet_damping, 0.0, 1e9);
  contact.read("rolling_resistance", c.rolling_resistance, 0.0, 1.0);
  contact.finish();
  map.finish();
  return options;
}

YAML::Node to_yaml(const SimulatorOptions& options) {
  YAML::Node contact;
  contact["solref_time_constant"] = options.contact.solref_time_constant;
  contact["solref_damping_ratio"] = options.contact.solref_damping_ratio;
  contact["bullet_stiffness"] = options.contact.bullet_stiffness;
  contact["bullet_damping"] = options.contact.bullet_damping;
  contact["rolling_resistance"] = options.contact.rolling_resistance;
  YAML::Node node;
  node["physics_step_us"] = options.steps.physics_us;
  node["control_step_us"] = options.steps.control_us;
  node["contact"] = contact;
  return node;
}

}  // namespace touchdown
