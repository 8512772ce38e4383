#include "scenarios/perturbation.hpp"

namespace touchdown {

Perturbation perturbation_from_yaml(YamlMap map) {
  Perturbation p;
  map.read("x", p.x, 0.0, 10.0);
  map.read("y", p.y, 0.0, 10.0);
  map.read("yaw", p.yaw, 0.0, 3.2);
  map.read("velocity", p.velocity, 0.0, 2.0);
  map.read("crouch", p.crouch, 0.0, 1.0);
  map.read("mass_scale", p.mass_scale, 0.0, 0.9);
  map.read("friction", p.friction, 0.0, 2.0);
  map.read("servo_gain_scale", p.servo_gain_scale, 0.0, 0.9);
  map.read("force_scale", p.force_scale, 0.0, 1.0);
  if (map.has("drive")) p.drive = random_drive_from_yaml(map.child("drive"));
  if (map.has("lift")) p.lift = random_lifts_from_yaml(map.child("lift"));
  map.finish();
  return p;
}

YAML::Node to_yaml(const Perturbation& p) {
  YAML::Node node;
  node["x"] = p.x;
  node["y"] = p.y;
  node["yaw"] = p.yaw;
  node["velocity"] = p.velocity;
  node["crouch"] = p.crouch;
  node["mass_scale"] = p.mass_scale;
  node["friction"] = p.friction;
  node["servo_gain_scale"] = p.servo_gain_scale;
  node["force_scale"] = p.force_scale;
  if (p.drive) node["drive"] = to_yaml(*p.drive);
  if (p.lift) node["lift"] = to_yaml(*p.lift);
  return node;
}

}  // namespace touchdown
