#include "models/robot_description.hpp"

#include <system_error>
#include <vector>

#include "core/fields.hpp"
#include "core/files.hpp"
#include "core/resources.hpp"

namespace touchdown::models {

static void describe(Fields& fields, LegActuators& actuators) {
  fields.section("hip", actuators.hip).doc("Actuators of the hips.");
  fields.section("knee", actuators.knee).doc("Actuators of the knees.");
  fields.section("wheel", actuators.wheel).doc("Actuators of the wheels.");
}

static void describe(Fields& fields, LegLengths& legs) {
  const auto length = [](double& value) {
    return [&value](Fields& leg) {
      leg("length", value, 0.2, 5.0).doc("Factor on the length of both links.");
    };
  };
  length(legs.both)(fields);
  fields.within("left", length(legs.one[0])).doc("The left leg, besides the factor of both.");
  fields.within("right", length(legs.one[1])).doc("The right leg, besides the factor of both.");
}

static void describe(Fields& fields, Stance& stance) {
  fields("hip", stance.hip, -1.26, 1.26).doc("rad", "Hip angle.");
  fields("knee", stance.knee, -2.51, 2.51).doc("rad", "Knee angle.");
}

void describe(Fields& fields, RobotDescription& robot) {
  std::string mjcf = robot.mjcf.string();
  fields.require("mjcf", mjcf).doc("MJCF that this file modifies, beside this file.");
  robot.mjcf = mjcf;
  fields("mass", robot.mass, 0.01, 100.0).doc("Factor on mass and inertia of every body.");
  fields.optional("wheel_radius", robot.wheel_radius, 0.005, 1.0)
      .fallback("as in the MJCF")
      .doc("m", "Radius of both tyres.");
  fields.section("legs", robot.legs).doc("Lengths of the legs.");
  fields.section("stance", robot.stance)
      .doc("Joint angles at the start, unless the scenario specifies them.");
  fields.section("actuators", robot.actuators)
      .doc("Actuators of both legs; absent joints stay as in the MJCF.");
  fields.know("balancer");
  fields.section("tyre", robot.tyre).doc("Contact model of both tyres.");
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
