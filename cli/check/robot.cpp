#include "cli/check/robot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include "core/program/streams.hpp"
#include "core/resources.hpp"
#include "core/table.hpp"
#include "scenarios/robot_check/robot_check.hpp"

namespace touchdown::cli {

namespace {

using Json = nlohmann::ordered_json;
using scenarios::CheckedHeldJoint;
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
  Table table{{"servo", "joint", "axis in the base", "sign", "zero (rad)", "range (rad)",
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

std::string text_of(const CheckedHeldJoint& held) {
  return fmt::format(
      "held: joint '{}' at {:g} rad by a servo of {:g} N·m/rad (from {}), {:g} N·m·s/rad and at "
      "most "
      "{:g} N·m{}\n",
      held.joint, rounded(held.reference), rounded(held.kp), held.kp_source, rounded(held.kd),
      held.torque_limit, held.actuator.empty() ? "" : "; " + held.actuator);
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
  }
  for (const CheckedHeldJoint& held : check.held) text += text_of(held);
  for (const std::string& ignored : check.ignored) text += "ignored: " + ignored + "\n";
  for (const std::string& difference : check.differences) {
    text += "engines differ: " + difference + "\n";
  }
  for (const CheckedStand& stand : check.stands) {
    text += fmt::format(
        "{}: {}, moved {:.2f} m, {:.1f} N on the left tyre, {:.1f} N on the right{}\n",
        stand.engine, stand.ending, stand.moved, stand.load[0], stand.load[1],
        check.held.empty() ? "" : fmt::format(", held joints within {:.3f} rad", stand.given_way));
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

Json json_of(const CheckedHeldJoint& held) {
  return {{"joint", held.joint},      {"reference_rad", rounded(held.reference)},
          {"kp", rounded(held.kp)},   {"kp_source", held.kp_source},
          {"kd", rounded(held.kd)},   {"torque_limit_nm", held.torque_limit},
          {"actuator", held.actuator}};
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
               {"differences", check.differences},
               {"stands", Json::array()}};
  for (const CheckedJoint& joint : check.joints) json["joints"].push_back(json_of(joint));
  for (const CheckedHeldJoint& held : check.held) json["held"].push_back(json_of(held));
  for (const CheckedStand& stand : check.stands) {
    json["stands"].push_back({{"engine", stand.engine},
                              {"stands", stand.stands},
                              {"ending", stand.ending},
                              {"moved_m", rounded(stand.moved)},
                              {"held_given_way_rad", rounded(stand.given_way)},
                              {"load_n", {rounded(stand.load[0]), rounded(stand.load[1])}}});
  }
  return json;
}

}  // namespace

bool is_robot_file(const std::string& path) {
  constexpr std::array extensions = {".xml", ".urdf", ".yaml", ".yml"};
  const std::string extension = std::filesystem::path(path).extension().string();
  return std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
}

std::size_t check_robot(const std::string& path, bool as_json, const CliSession& session) {
  const RobotCheck check =
      scenarios::check_robot(find_resource(path), [&] { return !*session.stop; });
  print(as_json ? json_of(path, check).dump(1) + "\n" : text_of(path, check));
  return check.complaints.size();
}

}  // namespace touchdown::cli
