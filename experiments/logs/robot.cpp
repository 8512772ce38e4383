#include "experiments/logs/robot.hpp"

#include <filesystem>

#include "core/resources.hpp"
#include "models/robot_model.hpp"
#include "scenarios/leg_geometry.hpp"

namespace touchdown::experiments {

LogRobot robot_called(const std::string& name_or_file) {
  const std::filesystem::path path(name_or_file);
  const bool is_file = path.extension() == ".xml" || path.extension() == ".yaml";
  if (!is_file) return {.name = name_or_file};
  return {.name = path.stem().string(),
          .legs = scenarios::leg_geometry(models::compile_robot_model(find_resource(path), {}))};
}

std::string robot_text(const std::string& name) {
  return name.empty() ? "an unnamed robot" : "'" + name + "'";
}

}  // namespace touchdown::experiments
