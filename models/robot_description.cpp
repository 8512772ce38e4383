#include "models/robot_description.hpp"

#include <system_error>
#include <vector>

#include "core/fields.hpp"
#include "core/files.hpp"
#include "core/resources.hpp"

namespace touchdown::models {

static void describe(Fields& fields, LegActuators& actuators) {
  fields.section("hip", actuators.hip);
  fields.section("knee", actuators.knee);
  fields.section("wheel", actuators.wheel);
}

static void describe(Fields& fields, LegLengths& legs) {
  const auto length = [](double& value) {
    return [&value](Fields& leg) { leg("length", value, 0.2, 5.0); };
  };
  length(legs.both)(fields);
  fields.within("left", length(legs.one[0]));
  fields.within("right", length(legs.one[1]));
}

static void describe(Fields& fields, Stance& stance) {
  fields("hip", stance.hip, -1.26, 1.26);
  fields("knee", stance.knee, -2.51, 2.51);
}

void describe(Fields& fields, RobotDescription& robot) {
  std::string mjcf = robot.mjcf.string();
  fields.require("mjcf", mjcf);
  robot.mjcf = mjcf;
  fields("mass", robot.mass, 0.01, 100.0);
  double radius = robot.wheel_radius.value_or(0.0);
  if (fields.reading() || radius > 0.0) fields("wheel_radius", radius, 0.005, 1.0);
  if (radius > 0.0) robot.wheel_radius = radius;
  fields.section("legs", robot.legs);
  fields.section("stance", robot.stance);
  fields.section("actuators", robot.actuators);
  fields.know("balancer");
  fields.section("tyre", robot.tyre);
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

bool is_about_an_mjcf(const std::filesystem::path& file) { return file.extension() == ".yaml"; }

RobotDescription robot_description(const std::filesystem::path& file) {
  if (!is_about_an_mjcf(file)) {
    RobotDescription alone;
    alone.mjcf = file;
    return alone;
  }
  const YamlDocument document = YamlDocument::load(file);
  auto robot = from_yaml<RobotDescription>(document);
  robot.mjcf = file.parent_path() / robot.mjcf;
  // Checked here, as the model may be compiled later, for the controller gains only.
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(robot.mjcf, ignored)) {
    std::vector<std::string> neighbours;
    for (const auto& mjcf : resources_in(robot.mjcf.parent_path(), ".xml")) {
      neighbours.push_back(mjcf.filename().string());
    }
    Fields(document).check(false, "mjcf",
                           robot.mjcf.string() + ": no such file" +
                               did_you_mean(robot.mjcf.filename().string(), neighbours));
  }
  return robot;
}

std::string robot_text(const std::filesystem::path& file) {
  const std::filesystem::path mjcf = robot_description(file).mjcf;
  return mjcf == file ? read_file(file) : read_file(file) + read_file(mjcf);
}

}  // namespace touchdown::models
