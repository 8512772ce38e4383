#include "policies/velocity_script.hpp"

#include <algorithm>

namespace touchdown {

VelocityCommand command_at(const VelocityScript& script, double time) {
  const auto later =
      std::upper_bound(script.begin(), script.end(), time,
                       [](double t, const VelocityCommand& command) { return t < command.time; });
  return later == script.begin() ? VelocityCommand{} : *std::prev(later);
}

VelocityScript velocity_script_from_yaml(YamlMap& parent, std::string_view key) {
  VelocityScript script;
  for (YamlMap& map : parent.children(key)) {
    VelocityCommand command;
    map.read("time", command.time, 0.0, 1e6);
    map.read("velocity", command.velocity, -3.0, 3.0);
    map.read("yaw_rate", command.yaw_rate, -10.0, 10.0);
    map.finish();
    if (!script.empty() && command.time <= script.back().time) {
      map.fail("time", "expected a later time than the command before");
    }
    script.push_back(command);
  }
  return script;
}

YAML::Node to_yaml(const VelocityScript& script) {
  YAML::Node list(YAML::NodeType::Sequence);
  for (const VelocityCommand& command : script) {
    YAML::Node node;
    node["time"] = command.time;
    node["velocity"] = command.velocity;
    node["yaw_rate"] = command.yaw_rate;
    list.push_back(node);
  }
  return list;
}

}  // namespace touchdown
