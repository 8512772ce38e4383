#include "scenarios/robot_check.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/resources.hpp"
#include "estimator/force/leg_geometry.hpp"
#include "logs/plausibility/channels.hpp"
#include "models/robot_description.hpp"
#include "models/robot_draft.hpp"
#include "models/robot_model.hpp"
#include "models/stance.hpp"
#include "scenarios/engine.hpp"
#include "scenarios/leg_geometry.hpp"
#include "scenarios/scenario.hpp"
#include "scenarios/scenario_file.hpp"
#include "scenarios/start_pose.hpp"
#include "simulators/registry.hpp"
#include "simulators/tyres.hpp"

namespace touchdown::scenarios {

std::string actuator_text(const models::Actuator& actuator, std::string text) {
  const auto add = [&](const char* what, double value) {
    if (value != 0.0) text += fmt::format("{}{} {:g}", text.empty() ? "" : ", ", what, value);
  };
  add("friction", actuator.friction);
  add("viscous", actuator.viscous);
  add("armature", actuator.armature);
  return text;
}

namespace {

/// The motor that counts as a servo's in a closed leg; empty if it is on the servo's joint.
std::string motor_text(const models::RobotModel& robot, std::size_t servo) {
  if (robot.motor_joint[servo] == robot.joint[servo]) return {};
  if (robot.motor_joint[servo] < 0) return "no motor";
  return "motor " + models::motor_name(robot, servo);
}

CheckedJoint checked(const models::RobotModel& robot, const mjData& data, std::size_t servo) {
  const int joint = robot.joint[servo];
  const mjtNum* const range = &robot.mj->jnt_range[2 * joint];
  CheckedJoint checked{.servo = std::string(models::servo_names[servo]),
                       .joint = robot.joint_name[servo],
                       .axis = models::vector_at(data.xaxis, joint),
                       .is_reversed = robot.is_reversed[servo],
                       .zero = robot.zero[servo],
                       .is_limited = robot.mj->jnt_limited[joint] != 0,
                       .low = range[0],
                       .high = range[1],
                       .torque_limit = robot.effort[servo],
                       .actuator = actuator_text(robot.actuator[servo], motor_text(robot, servo))};
  if (checked.is_reversed) checked.axis = -checked.axis + Eigen::Vector3d::Zero();
  return checked;
}

/// The mass that a leg's first joint moves.
double mass_below(const models::RobotModel& robot, std::size_t leg) {
  const std::size_t top = robot.has(3 * leg) ? 3 * leg : 3 * leg + 1;
  return robot.mj->body_subtreemass[robot.mj->jnt_bodyid[robot.joint[top]]];
}

/// How far the axles are in front of the centre of mass in a stance with an upright torso (m).
double axle_forward(const models::RobotModel& robot, const models::Stance& stance) {
  const simulators::RobotState pose =
      start_pose(robot, {}, {.hip = stance.hip, .knee = stance.knee});
  const models::MjDataPtr data =
      models::at_pose(robot, Eigen::Quaterniond::Identity(), pose.joint_position);
  return data->xanchor[3 * robot.joint[2]] - data->subtree_com[3 * robot.base_body];
}

/// Knee torque per newton of load, in the stance: the distance of the axle from the knee, level.
double lever_of(const models::RobotModel& robot, double hip, double knee) {
  LegSignals leg;
  leg.hip.position = hip;
  leg.knee.position = -knee;
  return std::abs(foot_jacobian(leg_geometry(robot), leg, false).lower_z);
}

std::vector<std::string> differences(const models::RobotModel& robot) {
  std::vector<std::string> all;
  if (robot.tyre.law == models::Tyre::Law::engine) {
    all.emplace_back(
        "tyres: each engine has its own contact model (tyre: {law: spring_damper} is "
        "the same in both)");
  }
  if (robot.mj->geom_type[robot.tyre_geom[0]] == mjGEOM_CYLINDER) {
    all.emplace_back(
        "tyres: cylinders have several contact points on flat ground, and their number "
        "differs; spheres have one");
  }
  const bool has_rotors = std::any_of(robot.actuator.begin(), robot.actuator.end(),
                                      [](const auto& a) { return a.armature != 0.0; });
  if (has_rotors) {
    all.emplace_back("armature: in Bullet, contacts see the rotor as a part of its link");
  }
  return all;
}

/// The largest angle of a held joint from its reference during a run (rad).
double given_way(const logs::Recording& recording, const std::vector<models::HeldJoint>& held) {
  double largest = 0.0;
  for (const models::GroundTruth& truth : recording.truth) {
    for (std::size_t i = 0; i < std::min(held.size(), truth.held.size()); ++i) {
      largest = std::max(largest, std::abs(truth.held[i].position - held[i].reference));
    }
  }
  return largest;
}

/// A scenario with its compiled scene.
struct Scene {
  Scenario scenario;
  std::shared_ptr<const models::RobotModel> robot;
  const std::function<bool()>& should_continue;
};

logs::Recording played(const Scene& scene, const std::string& engine) {
  const auto is_wanted = [&](double /*time*/ = 0.0) {
    return !scene.should_continue || scene.should_continue();
  };
  logs::Recording recording =
      play(scene.scenario, *make_simulator(scene.scenario, engine, scene.robot), 0, 0, is_wanted);
  if (!is_wanted()) throw Stopped("stopped");
  return recording;
}

/// `is_explained`: whether it is known why it cannot stand.
CheckedStand stand(const Scene& scene, const std::string& engine, bool is_explained,
                   RobotCheck& check) {
  logs::Recording recording = played(scene, engine);
  CheckedStand stand{.engine = engine,
                     .ending = ending_text(recording, scene.scenario.end),
                     .stands = recording.info.outcome == logs::Outcome::finished};
  stand.given_way = given_way(recording, check.held);
  if (!is_explained) stand.ending += part_on_terrain(*scene.robot, recording);
  stand.moved = (recording.truth.back().base_position - recording.truth.front().base_position)
                    .head<2>()
                    .norm();
  constexpr double averaged = 0.5;  // s
  const auto steps = std::min(recording.steps(),
                              static_cast<std::size_t>(std::lround(averaged / recording.period())));
  for (std::size_t k = recording.steps() - steps; k < recording.steps(); ++k) {
    for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
      stand.load[wheel] +=
          recording.truth[k].wheel_normal_force[wheel] / static_cast<double>(steps);
    }
  }
  if (check.standing.steps() == 0) check.standing = std::move(recording);
  return stand;
}

/// Complaints about a stand that ended well: a robot that rolls away, wheels that carry nothing, or
/// not the weight. Wheels that carry different loads are a warning, of the first engine.
void check_loads(const CheckedStand& stand, double weight, RobotCheck& check) {
  std::vector<std::string>& complaints = check.complaints;
  constexpr double farthest = 0.4;  // m
  if (stand.moved > farthest) {
    complaints.push_back(
        fmt::format("{}: standing: rolled {:.2f} m away within two seconds; in its stance the "
                    "axles are {:.2f} m {} its centre of mass: try another `stance`",
                    stand.engine, stand.moved, std::abs(check.axle_forward),
                    check.axle_forward > 0.0 ? "in front of" : "behind"));
  }
  constexpr double farthest_held = 0.2;  // rad
  if (stand.given_way > farthest_held) {
    complaints.push_back(
        fmt::format("{}: standing: a held joint gives way by {:.2f} rad: its servo is too weak "
                    "(held_servo)",
                    stand.engine, stand.given_way));
  }
  const double sum = stand.load[0] + stand.load[1];
  constexpr double tolerance = 0.2;
  if (std::abs(sum - weight) > tolerance * weight) {
    complaints.push_back(
        fmt::format("{}: standing: the tyres carry {:.1f} N, expected the weight, "
                    "{:.1f} N",
                    stand.engine, sum, weight));
  } else if (std::min(stand.load[0], stand.load[1]) < tolerance * weight) {
    complaints.push_back(
        fmt::format("{}: standing: {:.1f} N on the left tyre, {:.1f} N on the right", stand.engine,
                    stand.load[0], stand.load[1]));
  } else if (std::abs(stand.load[0] - stand.load[1]) > 0.5 * tolerance * weight &&
             check.stands.size() == 1) {
    check.warnings.push_back(
        fmt::format("{}: standing: the wheels carry different loads, left {:.1f} N, right {:.1f} "
                    "N: is a place or a mass of one leg wrong?",
                    stand.engine, stand.load[0], stand.load[1]));
  }
}

/// How a drop from 10 cm ended. Limit cycles of the servos are complaints, and falls of a robot
/// that stands; a part that touches the ground is a warning, since a lower step may suit the robot.
std::string drop(Scene scene, const CheckedStand& stand, RobotCheck& check) {
  scene.scenario.start.clearance = 0.1;  // m
  scene.scenario.end.duration = 1.0;     // s
  const logs::Recording recording = played(scene, stand.engine);
  logs::ChatterCheck chatter;
  for (const models::Observation& record : recording.observation) chatter.add(record);
  logs::Findings findings;
  chatter.report(findings);
  for (const std::string& line : findings.lines()) {
    check.complaints.push_back(fmt::format("{}: dropped from 10 cm: {}", stand.engine, line));
  }
  std::string ending = ending_text(recording, scene.scenario.end);
  if (stand.stands && recording.info.outcome != logs::Outcome::finished) {
    const std::string part = part_on_terrain(*scene.robot, recording);
    (part.empty() ? check.complaints : check.warnings)
        .push_back(fmt::format("{}: dropped from 10 cm: {}{}", stand.engine, ending, part));
  }
  return ending;
}

/// The way out for a robot that falls: its file does not choose gains, so they are Upkie's.
std::string hint_about_gains(const std::filesystem::path& file) {
  const bool has_gains =
      models::is_about_an_mjcf(file) && YamlDocument::load(file).root()["balancer"].IsDefined();
  return has_gains ? ""
                   : " (with the gains of Upkie: a YAML file about this robot may have 'balancer: "
                     "{gains: lqr}')";
}

/// Reads the robot. Returns why it cannot stand, if this is known.
std::string read_robot(const Scene& scene, RobotCheck& check) {
  const auto& [scenario, compiled, should_continue] = scene;
  const models::RobotModel& robot = *compiled;
  const models::MjDataPtr data = models::at_reference(robot);
  check.name = robot.name;
  check.mass = mj_getTotalmass(robot.mj.get());
  check.leg_mass = {mass_below(robot, 0), mass_below(robot, 1)};
  check.wheel_radius = robot.wheel_radius;
  check.track = (models::vector_at(data->geom_xpos, robot.tyre_geom[0]) -
                 models::vector_at(data->geom_xpos, robot.tyre_geom[1]))
                    .norm();
  check.imu = robot.imu_position;
  for (std::size_t i = 0; i < models::servo_count; ++i) {
    if (robot.has(i)) check.joints.push_back(checked(robot, *data, i));
  }
  check.held = robot.held;
  check.hip = robot.has(0) ? scenario.start.hip : 0.0;
  check.knee = scenario.start.knee;
  check.lever = lever_of(robot, check.hip, check.knee);
  const simulators::RobotState pose = start_pose(robot, {}, {.hip = check.hip, .knee = check.knee});
  check.margins =
      policies::servo_margins(robot,
                              {pose.orientation, pose.joint_position,
                               1e-6 * static_cast<double>(scenario.simulation.steps.physics_us)},
                              scenario.balancer);
  if (const double least = std::min(check.margins.flight, check.margins.standing); least <= 1.0) {
    check.complaints.push_back(fmt::format(
        "servos: unstable at this physics step, gain margin {:.2f}, expected above 1: "
        "lower the gains (balancer, held_servo), or derive them (balancer: {{gains: lqr}})",
        least));
  }
  const Eigen::Vector3d centre = models::vector_at(data->subtree_com, robot.base_body);
  const Eigen::Vector3d axle = models::vector_at(data->xanchor, robot.joint[2]);
  constexpr double farthest = 3.0;  // times the distance of an axle
  if (const double away = (check.imu - centre).norm(); away > farthest * (axle - centre).norm()) {
    check.complaints.push_back(fmt::format(
        "IMU: expected it on the base, found it {:.3g} m from the robot's centre of mass", away));
  }
  check.ignored = robot.ignored;
  check.warnings = robot.warnings;
  check.differences = differences(robot);
  const models::MjDataPtr standing = models::at_pose(robot, pose.orientation, pose.joint_position);
  check.axle_forward = axle_forward(robot, {check.hip, check.knee});
  return models::reason_to_fall(robot, *data, *standing);
}

/// The parts beside the tyres within a centimetre of the terrain, and how far they are (m).
std::map<std::string, double> parts_near_terrain(const models::RobotModel& robot, mjData& data) {
  const mjModel& mj = *robot.mj;
  const std::vector<mjtNum> margins(mj.geom_margin, mj.geom_margin + mj.ngeom);
  std::fill_n(mj.geom_margin, mj.ngeom, 0.01);
  mj_fwdPosition(&mj, &data);
  std::ranges::copy(margins, mj.geom_margin);
  std::map<std::string, double> parts;
  for (int i = 0; i < data.ncon; ++i) {
    const mjContact& contact = data.contact[i];
    for (const int geom : {contact.geom1, contact.geom2}) {
      if (mj.geom_bodyid[geom] == 0 || simulators::wheel_of_tyre(robot, geom)) continue;
      const char* name = mj_id2name(&mj, mjOBJ_GEOM, geom);
      if (name == nullptr) name = mj_id2name(&mj, mjOBJ_BODY, mj.geom_bodyid[geom]);
      if (name == nullptr) continue;
      const auto part = parts.emplace(name, contact.dist).first;
      part->second = std::min(part->second, contact.dist);
    }
  }
  return parts;
}

/// The usual stance, or, if that has the axles elsewhere than below the centre of mass, one with
/// other hips that has them there.
models::Stance drafted_stance(const models::RobotModel& robot) {
  constexpr double enough = 0.005;  // m: with more, a balancer rolls away at first
  const models::Stance usual = models::usual_stance(robot);
  if (robot.closed_leg[0] || !robot.has(0) || std::abs(axle_forward(robot, usual)) < enough) {
    return usual;
  }
  models::Stance stance = usual;
  for (int i = 0; i < 5; ++i) {  // Newton's method
    constexpr double step = 0.01;
    const double offset = axle_forward(robot, stance);
    stance.hip -= step * offset / (axle_forward(robot, {stance.hip + step, stance.knee}) - offset);
  }
  constexpr double farthest = 0.3;  // rad: beyond, the mass is elsewhere than the file has it
  const bool is_near = std::abs(stance.hip - usual.hip) < farthest;
  return is_near && !models::stance_error(robot, stance) ? stance : usual;
}

/// What the robot's compiled model adds to its draft: the stance, colliders that would touch the
/// terrain as it stands, and the signs of its joints.
void complete_draft(const models::RobotModel& robot, std::vector<models::DraftLine>& draft) {
  const models::Stance stance = drafted_stance(robot);
  const models::Stance in_file = models::in_zeros_of_file(robot, stance);
  const std::string hip = robot.has(0) ? fmt::format("hip: {:.4f}, ", in_file.hip) : "";
  draft.push_back({"stance", fmt::format("{{{}knee: {:.4f}}}", hip, in_file.knee),
                   stance.hip == models::usual_stance(robot).hip
                       ? "rad, in the zeros of the file's joints: what the robot would take anyway"
                       : "rad, in the zeros of the file's joints: axles below the centre of mass"});
  const simulators::RobotState pose =
      start_pose(robot, {}, {.hip = stance.hip, .knee = stance.knee});
  const models::MjDataPtr data = models::at_reference(robot);
  models::write_pose(robot, pose.position, pose.orientation, pose.joint_position, data->qpos);
  std::vector<std::string> near;
  for (const auto& [part, distance] : parts_near_terrain(robot, *data))
    near.push_back(models::as_yaml(part));
  if (!near.empty()) {
    draft.push_back({"no_collision", fmt::format("[{}]", fmt::join(near, ", ")),
                     "within 1 cm of the ground as it stands"});
  }
  std::vector<std::string> signs;
  std::vector<std::string> motors;
  for (std::size_t i = 0; i < models::servo_count; ++i) {
    if (robot.has(i)) signs.emplace_back(robot.is_reversed[i] ? "-1" : "1");
    if (robot.motor_joint[i] >= 0) motors.push_back(models::motor_name(robot, i));
  }
  draft.push_back(
      {"", "",
       robot.closed_leg[0]
           ? fmt::format("Mapping files name this file as `closed_legs`, and as joints: {}",
                         fmt::join(motors, ", "))
           : fmt::format("In mapping files, `sign` of its joints: [{}]", fmt::join(signs, ", "))});
}

}  // namespace

std::vector<std::string> draft_robot(const std::filesystem::path& robot,
                                     const std::filesystem::path& yaml) {
  std::vector<models::DraftLine> draft = models::drafted_robot(robot);
  const std::string mjcf =
      absolute_path(robot).lexically_proximate(absolute_path(yaml).parent_path()).string();
  write_atomically(yaml, models::text_of(draft, mjcf));
  try {
    complete_draft(models::compile_robot_model(yaml, {}), draft);
    write_atomically(yaml, models::text_of(draft, mjcf));
  } catch (const InputError&) {
    // `check_robot` gives the reasons.
  }
  std::vector<std::string> guesses;
  for (const models::DraftLine& line : draft) {
    if (line.comment.find("guess") == std::string::npos) continue;
    const bool is_block = line.value.empty() || line.value.front() == '\n';
    guesses.push_back(fmt::format("{}: {}: {}{}", yaml.string(), line.key,
                                  is_block ? "" : line.value + "  # ", line.comment));
  }
  return guesses;
}

std::string part_on_terrain(const models::RobotModel& robot, const logs::Recording& recording) {
  if (recording.info.outcome != logs::Outcome::fell || recording.truth.empty() ||
      !recording.truth.back().body_touches_terrain) {
    return {};
  }
  const models::MjDataPtr data = models::at_reference(robot);
  const models::GroundTruth& last = recording.truth.back();
  std::array<double, models::servo_count> joints = {};
  for (std::size_t i = 0; i < joints.size(); ++i) {
    joints[i] = recording.observation.back().servo[i].position;
  }
  models::write_pose(robot, last.base_position, last.base_orientation, joints, data->qpos);
  // The terrain is near at the last record, and touched a step later.
  const std::map<std::string, double> parts = parts_near_terrain(robot, *data);
  const auto nearest = std::min_element(
      parts.begin(), parts.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  if (nearest == parts.end()) return {};
  return fmt::format(": '{0}' (`no_collision: [{0}]` in the robot's YAML file leaves it out)",
                     nearest->first);
}

RobotCheck check_robot(const std::filesystem::path& file,
                       const std::function<bool()>& should_continue) {
  RobotCheck check;
  try {
    check.robot = std::make_shared<const models::RobotModel>(
        models::compile_robot_model(find_resource(file), {}));
    // First, as there may be no stance within the ranges.
    check.complaints = models::range_complaints(*check.robot);
    const YamlDocument stand_scene =
        YamlDocument::parse("name: stand\nend: {duration: 2}\n", "stand");
    YAML::Node(stand_scene.root())["robot"] = file.string();  // it need not be UTF-8
    const Scene scene = {complete_scenario(stand_scene, check.robot), check.robot, should_continue};
    const std::string reason = read_robot(scene, check);
    constexpr double gravity = 9.81;
    for (const std::string& engine : simulators::simulator_names()) {
      check.stands.push_back(stand(scene, engine, !reason.empty(), check));
      CheckedStand& last = check.stands.back();
      if (!last.stands) {
        check.complaints.push_back(
            fmt::format("{}: standing: {}{}", engine, last.ending,
                        reason.empty() ? hint_about_gains(scene.scenario.robot) : ": " + reason));
      } else {
        check_loads(last, gravity * check.mass, check);
      }
      last.drop = drop(scene, last, check);
    }
  } catch (const InputError& error) {
    check.complaints.emplace_back(error.what());
  }
  return check;
}

}  // namespace touchdown::scenarios
