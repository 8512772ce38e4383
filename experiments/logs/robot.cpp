#include "experiments/logs/robot.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/resources.hpp"
#include "experiments/config/yaml_kind.hpp"
#include "experiments/estimators/fits.hpp"
#include "models/robot_description.hpp"
#include "models/robot_model.hpp"
#include "scenarios/leg_geometry.hpp"

namespace touchdown::experiments {

namespace {

logs::JointRanges ranges_of(const models::RobotModel& robot) {
  logs::JointRanges ranges;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const int joint = robot.mj->dof_jntid[robot.dof_address[i]];
    const bool is_limited = robot.mj->jnt_limited[joint] != 0;
    constexpr double turn = 6.283185307179586;
    ranges[i] = is_limited ? logs::JointRange{robot.mj->jnt_range[2 * joint],
                                              robot.mj->jnt_range[2 * joint + 1]}
                           : logs::JointRange{-turn, turn};
  }
  return ranges;
}

LogRobot robot_in_file(const std::filesystem::path& path) {
  const std::filesystem::path file = find_resource(path);
  if (models::is_about_an_mjcf(path)) {
    require_yaml_kind(YamlDocument::load(file), YamlKind::robot);
  }
  const models::RobotModel robot = models::compile_robot_model(file, {});
  return {.name = path.stem().string(),
          .legs = scenarios::leg_geometry(robot),
          .ranges = ranges_of(robot)};
}

/// The recorded robot's file, also where its path is one beside the log.
std::filesystem::path found_robot(const logs::RecordingInfo& log) {
  std::filesystem::path robot = robot_file_of(log);
  std::filesystem::path beside = log.folder / robot;
  const bool is_missing = !robot.empty() && robot.is_relative() && !is_there(robot);
  return is_missing && is_there(beside) ? beside : robot;
}

/// "its robot … was changed since the recording"; empty for the recorded robot. Errors:
/// `InputError` for a file that cannot be read.
std::string change_of(const std::filesystem::path& robot, const logs::RecordingInfo& log) {
  if (log.robot_digest.empty() || log.robot_digest == models::robot_digest(find_resource(robot))) {
    return {};
  }
  return fmt::format("its robot {}, or a file that this reads, was changed since the recording",
                     robot.string());
}

constexpr const char* expected_file = "expected a robot's file (.xml, .urdf, .yaml)";

bool is_robots_file(const std::filesystem::path& path) {
  return path.extension() == ".xml" || path.extension() == ".urdf" ||
         models::is_about_an_mjcf(path);
}

}  // namespace

LogRobot robot_called(const std::string& name_or_file) {
  if (is_robots_file(name_or_file)) return robot_in_file(name_or_file);
  // Another file is no name: the legs would be Upkie's without a word.
  const bool is_other_file = is_there(name_or_file) && !is_folder(name_or_file);
  if (is_other_file || name_or_file.find('/') != std::string::npos) {
    throw InputError(fmt::format("{}: {}, or the name of a robot", name_or_file, expected_file));
  }
  return {.name = name_or_file};
}

LogRobot robot_of_file(const std::string& file) {
  if (file.empty()) return {};
  if (!is_robots_file(file)) {
    throw InputError(fmt::format("{}: {}", file, expected_file));
  }
  return robot_in_file(file);
}

logs::CheckedRobot checked_robot(const LogRobot& requested, const logs::RecordingInfo& log) {
  if (requested.legs) return {requested.legs, requested.ranges};
  const std::filesystem::path file = found_robot(log);
  if (file.empty()) return {};
  constexpr const char* advice = "the robot's file as it was then, after --robot, is used instead";
  try {
    const LogRobot robot = robot_in_file(file);
    const std::string change = change_of(file, log);
    return {
        robot.legs, robot.ranges,
        change.empty() ? "" : fmt::format("{}: the legs are those of today ({})", change, advice)};
  } catch (const InputError& error) {
    return {.doubt = fmt::format("the legs are assumed to be Upkie's, because its robot cannot be "
                                 "read: {} ({})",
                                 error.what(), advice)};
  }
}

void require_recorded_robot(const logs::RecordingInfo& recording, const std::string& name) {
  const std::filesystem::path robot = found_robot(recording);
  if (robot.empty()) return;
  const std::string change = change_of(robot, recording);
  if (change.empty()) return;
  throw InputError(fmt::format(
      "{}: {}: restore it, or simulate the run with today's: touchdown simulate RECORDING --set "
      "robot={}",
      name, change, robot.string()));
}

std::string robot_text(const std::string& name) {
  return name.empty() ? "an unnamed robot" : "'" + name + "'";
}

}  // namespace touchdown::experiments
