#include <string>

#include "core/error.hpp"
#include "models/mjcf/document.hpp"
#include "models/mjcf/parts.hpp"
#include "models/mjcf/robot_file.hpp"
#include "models/robot_description.hpp"
#include "tests/fuzz/entry.hpp"
#include "tests/fuzz/memory_file.hpp"

namespace touchdown::fuzz {

namespace {

constexpr std::string_view own_part_names = R"(mjcf: robot.xml
joints: {left_hip: lh, left_knee: lk, left_wheel: lw, right_hip: rh, right_knee: rk, right_wheel: rw}
held: [arm]
tyres: {left: lt, right: rim}
imu: chip
)";

models::RobotDescription named_robot() {
  models::RobotDescription robot;
  robot.parts.joint = {"lh", "lk", "lw", "rh", "rk", "rw"};
  robot.parts.held = {"arm"};
  robot.parts.tyre = {"lt", "rim"};
  robot.parts.imu = "chip";
  robot.is_named = true;
  return robot;
}

}  // namespace

/// A robot's MJCF, with its own names or those of the contract, up to its compilation by MuJoCo.
TOUCHDOWN_FUZZ(mjcf) {
  static const MemoryFile keys(own_part_names);
  const MemoryFile file(input);
  for (const models::RobotDescription& robot : {models::RobotDescription(), named_robot()}) {
    try {
      models::MjcfDocument document = models::MjcfDocument::load(file.path());
      (void)models::keep_robot_only(document);
      (void)models::drop_missing_assets(document);
      models::name_parts(document, robot, {}, models::RobotKeys(keys.path()));
      models::swap_sides(document);
      (void)document.text("<option/>\n").place_of_name("left_hip");
    } catch (const Error& error) {
      expected(error, input);
    }
  }
}

}  // namespace touchdown::fuzz
