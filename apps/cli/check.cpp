#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "apps/cli/log_options.hpp"
#include "apps/cli/verb.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "core/program.hpp"
#include "core/resources.hpp"
#include "core/stop.hpp"
#include "core/table.hpp"
#include "estimator/npz/npz.hpp"
#include "experiments/config/yaml_kind.hpp"
#include "experiments/logs/log_steps.hpp"
#include "experiments/logs/robot.hpp"
#include "experiments/results/captions.hpp"
#include "logs/log/reader.hpp"
#include "models/robot_description.hpp"
#include "models/robot_model.hpp"
#include "render/film/video.hpp"
#include "scenarios/robot_check.hpp"

namespace touchdown::cli {

namespace {

using Json = nlohmann::ordered_json;

using scenarios::CheckedJoint;
using scenarios::CheckedStand;
using scenarios::RobotCheck;

/// Without the digits that come from the arithmetic.
double rounded(double value) { return std::round(1e6 * value) / 1e6 + 0.0; }

std::string vector_text(const Eigen::Vector3d& v) {
  return fmt::format("({:g} {:g} {:g})", rounded(v.x()), rounded(v.y()), rounded(v.z()));
}

std::string range_text(const CheckedJoint& joint) {
  if (!joint.is_limited) return "none";
  return fmt::format("{:g} to {:g}", rounded(joint.low), rounded(joint.high));
}

std::string joints_text(const RobotCheck& check) {
  TextTable table{{"servo", "joint", "axis in the base", "sign", "zero (rad)", "range (rad)",
                   "limit (N·m)", "actuator"},
                  {}};
  for (const CheckedJoint& joint : check.joints) {
    table.rows.push_back({joint.servo, joint.joint, vector_text(joint.axis),
                          joint.is_reversed ? "reversed" : "kept",
                          fmt::format("{:g}", rounded(joint.zero)), range_text(joint),
                          fmt::format("{:g}", joint.torque_limit),
                          joint.actuator.empty() ? "ideal" : joint.actuator});
  }
  return to_text(table);
}

std::string text_of(const models::HeldJoint& held) {
  const std::string actuator = scenarios::actuator_text(held.actuator);
  return fmt::format(
      "held: joint '{}' at {:g} rad by a servo of {:g} N·m/rad (from {}), {:g} N·m·s/rad and at "
      "most "
      "{:g} N·m{}\n",
      held.name, rounded(held.reference), rounded(held.kp), held.kp_source, rounded(held.kd),
      held.effort, actuator.empty() ? "" : "; " + actuator);
}

std::string text_of(const std::string& path, const RobotCheck& check) {
  std::string text;
  if (!check.joints.empty()) {
    text += fmt::format(
        "{}: {}, {:g} kg, legs {:g} and {:g} kg, wheel radius {:g} m, track {:g} m, IMU at {} m\n{}"
        "stance: hip {:g}, knee {:g} rad; a load of 1 N gives {:.4f} N·m at the knee\n",
        path, check.name, rounded(check.mass), rounded(check.leg_mass[0]),
        rounded(check.leg_mass[1]), rounded(check.wheel_radius), rounded(check.track),
        vector_text(check.imu), joints_text(check), rounded(check.hip), rounded(check.knee),
        check.lever);
    text += fmt::format("servos: gain margin {:.2f} in flight, {:.2f} standing (unstable at 1)\n",
                        check.margins.flight, check.margins.standing);
  }
  for (const models::HeldJoint& held : check.held) text += text_of(held);
  for (const std::string& ignored : check.ignored) text += "ignored: " + ignored + "\n";
  for (const std::string& warning : check.warnings) text += "warning: " + warning + "\n";
  for (const std::string& difference : check.differences) {
    text += "engines differ: " + difference + "\n";
  }
  for (const CheckedStand& stand : check.stands) {
    text += fmt::format(
        "{}: {}, moved {:.2f} m, {:.1f} N on the left tyre, {:.1f} N on the right{}\n"
        "{}: dropped from 10 cm: {}\n",
        stand.engine, stand.ending, stand.moved, stand.load[0], stand.load[1],
        check.held.empty() ? "" : fmt::format(", held joints within {:.3f} rad", stand.given_way),
        stand.engine, stand.drop);
  }
  for (const std::string& complaint : check.complaints) text += "complaint: " + complaint + "\n";
  return text;
}

Json json_of(const Eigen::Vector3d& v) { return {rounded(v.x()), rounded(v.y()), rounded(v.z())}; }

Json json_of(const CheckedJoint& joint) {
  Json json = {{"servo", joint.servo},
               {"joint", joint.joint},
               {"axis_in_base", json_of(joint.axis)},
               {"is_reversed", joint.is_reversed},
               {"zero_rad", rounded(joint.zero)},
               {"torque_limit_nm", joint.torque_limit},
               {"actuator", joint.actuator}};
  json["range_rad"] =
      joint.is_limited ? Json{rounded(joint.low), rounded(joint.high)} : Json(nullptr);
  return json;
}

Json json_of(const models::HeldJoint& held) {
  return {{"joint", held.name},
          {"reference_rad", rounded(held.reference)},
          {"kp", rounded(held.kp)},
          {"kp_source", held.kp_source},
          {"kd", rounded(held.kd)},
          {"torque_limit_nm", held.effort},
          {"actuator", scenarios::actuator_text(held.actuator)}};
}

Json json_of(const std::string& path, const RobotCheck& check) {
  Json json = {{"file", path},
               {"is_usable", check.complaints.empty()},
               {"complaints", check.complaints},
               {"name", check.name},
               {"mass_kg", rounded(check.mass)},
               {"leg_mass_kg", {rounded(check.leg_mass[0]), rounded(check.leg_mass[1])}},
               {"wheel_radius_m", rounded(check.wheel_radius)},
               {"track_m", rounded(check.track)},
               {"imu_m", json_of(check.imu)},
               {"stance_rad", {{"hip", rounded(check.hip)}, {"knee", rounded(check.knee)}}},
               {"knee_lever_m", rounded(check.lever)},
               {"joints", Json::array()},
               {"held", Json::array()},
               {"ignored", check.ignored},
               {"warnings", check.warnings},
               {"differences", check.differences},
               {"stands", Json::array()}};
  json["servo_gain_margin"] = {{"flight", rounded(check.margins.flight)},
                               {"standing", rounded(check.margins.standing)}};
  for (const CheckedJoint& joint : check.joints) json["joints"].push_back(json_of(joint));
  for (const models::HeldJoint& held : check.held) json["held"].push_back(json_of(held));
  for (const CheckedStand& stand : check.stands) {
    json["stands"].push_back({{"engine", stand.engine},
                              {"stands", stand.stands},
                              {"ending", stand.ending},
                              {"moved_m", rounded(stand.moved)},
                              {"held_given_way_rad", rounded(stand.given_way)},
                              {"drop", stand.drop},
                              {"load_n", {rounded(stand.load[0]), rounded(stand.load[1])}}});
  }
  return json;
}

/// Whether a file describes a robot, by its extension.
bool is_robot_file(const std::string& path) {
  constexpr std::array extensions = {".xml", ".urdf", ".xacro", ".sdf", ".yaml", ".yml"};
  const std::string extension = std::filesystem::path(path).extension().string();
  return std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
}

struct CheckFlags {
  std::vector<std::string> files;
  std::string mapping;
  std::string robot;
  std::string draft;   ///< YAML file to write
  std::string figure;  ///< PNG to write
  std::string legs;    ///< arrays of closed legs to write
  bool strict = false;
  bool json = false;
};

/// Writes what a program on the robot needs to know of closed legs.
void write_legs(const models::RobotModel& robot, const std::string& path) {
  if (!robot.closed_leg[0]) throw InputError("--legs: expected a robot with closed legs");
  write_atomically(path, to_npz(arrays_of(models::closed_legs(robot)), path, Deflated::large));
}

/// Checks one robot and prints what was read, what is ignored and how it stands, as text or as
/// JSON. Returns the number of complaints. Errors: `Stopped`.
std::size_t check_robot(const std::string& path, const CheckFlags& flags,
                        const CliSession& session) {
  std::filesystem::path robot = find_resource(path);
  RobotCheck check;
  try {
    if (!flags.draft.empty()) {
      print_warnings(scenarios::draft_robot(robot, flags.draft));
      robot = flags.draft;
    }
    check = scenarios::check_robot(robot, [&] { return !*session.stop; });
  } catch (const InputError& error) {
    check.complaints.emplace_back(error.what());
  }
  if (!flags.legs.empty() && check.robot) write_legs(*check.robot, flags.legs);
  print(flags.json ? json_of(path, check).dump(1, ' ', false, Json::error_handler_t::replace) + "\n"
                   : text_of(path, check));
  if (!flags.figure.empty() && check.standing.steps() > 0) {
    render::render_scene(*check.robot, check.standing, {}, 0.0, flags.figure);
  }
  return check.complaints.size();
}

/// Checks one log and prints its rate, its length and what is implausible about it, one line each.
/// `mapping` is the mapping file of another robot's log or bag; empty for a log in Upkie's layout.
/// Returns the number of findings. Errors: `InputError` for a log that cannot be read.
std::size_t check_log(const std::string& path, const std::string& mapping,
                      const experiments::LogRobot& robot, const CliSession& session) {
  logs::LogReader reader = open_log(path, {.mapping = mapping}, session);
  experiments::LogSteps log(reader, nullptr, robot);
  std::int64_t steps = 0;
  double last = 0.0;
  while (const experiments::LogStep* step = log.next()) {
    ++steps;
    last = step->signals.time;
  }
  end_if(session.stop);
  print_warnings(reader.warnings());
  const std::vector<std::string> findings = log.findings();
  const bool is_short = static_cast<double>(steps) / log.sample_rate() < logs::shortest_log;
  std::string text = fmt::format(
      "{}: {} records at {:.6g} Hz, up to {} s: {}\n", reader.name(), steps, log.sample_rate(),
      fixed(last, 3),
      !findings.empty() ? "check it"
      : is_short ? fmt::format("too short to judge: expected {:g} s and more", logs::shortest_log)
                 : "plausible");
  for (const std::string& finding : findings) text += fmt::format("  {}\n", finding);
  print(text);
  return findings.size();
}

/// The type of a file follows from its extension; with a mapping all files are logs. Returns what
/// counts: complaints about a robot always, findings about a log if --strict.
std::size_t check_file(const std::string& file, const CheckFlags& flags,
                       const CliSession& session) {
  if (flags.mapping.empty() && is_robot_file(file)) {
    if (models::is_about_an_mjcf(file)) {
      experiments::require_yaml_kind(YamlDocument::load(file), experiments::YamlKind::robot);
    }
    return check_robot(file, flags, session);
  }
  if (flags.json) throw InputError(fmt::format("{}: --json is for robots", file));
  const std::size_t findings =
      check_log(file, flags.mapping, experiments::robot_of_file(flags.robot), session);
  return flags.strict ? findings : 0;
}

/// Checks --write and --figure before anything is computed.
void require_outputs(const CheckFlags& flags) {
  const auto require_robot = [&](const char* option) {
    if (flags.files.size() == 1 && flags.mapping.empty() && is_robot_file(flags.files[0])) return;
    throw InputError(fmt::format("{}: expected one robot", option));
  };
  if (!flags.draft.empty()) {
    require_robot("--write");
    if (models::is_about_an_mjcf(flags.files[0])) {
      throw InputError(flags.files[0] + ": --write: expected an MJCF or a URDF");
    }
    if (!models::is_about_an_mjcf(flags.draft)) {
      throw InputError(flags.draft + ": --write: expected a file with the extension .yaml");
    }
    if (is_there(flags.draft)) {
      throw InputError(flags.draft + ": --write: exists already; expected a new file");
    }
    require_writable(flags.draft);
  }
  for (const auto& [option, path] :
       {std::pair("--figure", &flags.figure), {"--legs", &flags.legs}}) {
    if (path->empty()) continue;
    require_robot(option);
    if (path == &flags.figure) require_extension(*path, {".png"}, "a figure");
    require_writable(*path);
  }
}

void check(const CheckFlags& flags, const CliSession& session) {
  require_outputs(flags);
  std::size_t all = 0;
  for (const std::string& file : flags.files) all += check_file(file, flags, session);
  if (all > 0) throw Error("check: " + experiments::plural(all, "finding"));
}

}  // namespace

void add_check(CLI::App& program, const CliSession& session) {
  Verb verb(program, "check",
            "touchdown check models/upkie.xml\n"
            "touchdown check theirs.urdf --write theirs.yaml --figure theirs.png\n"
            "touchdown check robot.mpack --robot my_robot.xml --strict\n"
            "touchdown check rosbag2_2026_03_01/ --mapping robot.yaml\n\n"
            "Checks robots and logs. Of a robot it prints what was read from its file, what is\n"
            "ignored, its servos' gain margins, where the engines differ, and how it stands for\n"
            "two seconds in each and comes down from 10 cm. The exit code is 1 if it cannot be\n"
            "simulated. Of a log it checks whether the signals can be those of a wheeled biped:\n"
            "clock, units, signs, axes, gravity, loads, dead channels. It prints one line per\n"
            "finding, with its likely cause. With --mapping it reads another robot's logs: ROS 2\n"
            "bags, CSV or NumPy arrays.");
  const auto flags = std::make_shared<CheckFlags>();
  verb.option("file", &flags->files,
              "Robots: MJCF files, or YAML files about an MJCF or URDF. Logs in Upkie's layout, "
              "or in another one with --mapping; - is standard input")
      .value_name("FILE")
      .required();
  verb.option("--mapping", &flags->mapping,
              "Maps the columns or topics of the logs to signals, as for `touchdown convert`")
      .value_name("FILE.yaml");
  verb.option("--robot", &flags->robot,
              "File of the robot that recorded the logs: gives weight, legs and ranges of joints\n"
              "(default: that of a simulated log, else Upkie's)")
      .value_name("FILE");
  verb.option("--write", &flags->draft,
              "Writes the YAML file about a robot from its MJCF or URDF, whatever its parts are\n"
              "called, with a comment at each guess; then checks the robot by this file")
      .value_name("FILE.yaml");
  verb.option("--figure", &flags->figure, "Draws the standing robot").value_name("FILE.png");
  verb.option("--legs", &flags->legs,
              "Writes closed legs for programs on the robot, which know motors only")
      .value_name("FILE.npz");
  verb.flag("--strict", &flags->strict, "Exit with code 1 if there is a finding about a log");
  verb.flag("--json", &flags->json, "Print JSON about robots");
  verb.action([flags, &session] { check(*flags, session); });
}

}  // namespace touchdown::cli
