#include "models/robot_description.hpp"

#include "core/fields.hpp"
#include "core/files.hpp"

namespace touchdown::models {

static void describe(Fields& fields, LegActuators& actuators) {
  fields.section("hip", actuators.hip);
  fields.section("knee", actuators.knee);
  fields.section("wheel", actuators.wheel);
}

static void describe(Fields& fields, RobotDescription& robot) {
  std::string mjcf = robot.mjcf.string();
  fields.require("mjcf", mjcf);
  robot.mjcf = mjcf;
  fields.section("actuators", robot.actuators);
}

const std::optional<Actuator>& RobotDescription::actuator(Servo servo) const {
  switch (static_cast<int>(servo) % 3) {
    case 0:
      return actuators.hip;
    case 1:
      return actuators.knee;
    default:
      return actuators.wheel;
  }
}

RobotDescription robot_description(const std::filesystem::path& file) {
  if (file.extension() != ".yaml") return {.mjcf = file, .actuators = {}};
  auto robot = from_yaml<RobotDescription>(YamlDocument::load(file));
  robot.mjcf = file.parent_path() / robot.mjcf;
  return robot;
}

std::string robot_text(const std::filesystem::path& file) {
  const std::filesystem::path mjcf = robot_description(file).mjcf;
  return mjcf == file ? read_file(file) : read_file(file) + read_file(mjcf);
}

}  // namespace touchdown::models
