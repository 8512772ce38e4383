#include "policies/force_script.hpp"

#include <Eigen/Geometry>

#include "policies/vector_yaml.hpp"

namespace touchdown {

Eigen::Vector3d force_in_world(const TimedForce& force, double yaw) {
  if (!force.along_heading) return force.force;
  return Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) * force.force;
}

ForceScript force_script_from_yaml(YamlMap& parent, std::string_view key) {
  ForceScript script;
  for (YamlMap& map : parent.children(key)) {
    TimedForce force;
    map.read("time", force.time, 0.0, 1e6);
    map.read("duration", force.duration, 0.0, 1e6);
    read_vector(map, "force", force.force);
    read_vector(map, "point_in_base", force.point_in_base);
    map.read("along_heading", force.along_heading);
    map.finish();
    script.push_back(force);
  }
  return script;
}

YAML::Node to_yaml(const ForceScript& script) {
  YAML::Node list(YAML::NodeType::Sequence);
  for (const TimedForce& force : script) {
    YAML::Node node;
    node["time"] = force.time;
    node["duration"] = force.duration;
    node["force"] = to_node(force.force);
    node["point_in_base"] = to_node(force.point_in_base);
    node["along_heading"] = force.along_heading;
    list.push_back(node);
  }
  return list;
}

}  // namespace touchdown
