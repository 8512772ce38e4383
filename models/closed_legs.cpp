#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include <fmt/format.h>

#include "models/robot_source.hpp"

namespace touchdown::models {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::array<const char*, wheel_count> sides = {"left", "right"};

/// The hinges of all closed legs, as a graph: joints of one leg have one root.
class Hinges {
 public:
  Hinges(const RobotModel& robot, const RobotSource& source)
      : robot_(robot), source_(source), above_(static_cast<std::size_t>(robot.mj->njnt)) {
    std::iota(above_.begin(), above_.end(), 0);
    const mjModel& model = *robot.mj;
    for (int joint = 0; joint < model.njnt; ++joint) {
      if (is_hinge(joint)) unite(joint, mover(model.body_parentid[model.jnt_bodyid[joint]]));
    }
    for (int i = 0; i < model.neq; ++i) {
      unite(end(i, model.eq_obj1id[i]), end(i, model.eq_obj2id[i]));
      if (root(robot.joint[0]) == root(robot.joint[3])) {
        source.fail_at_equality(i, "expected a loop in one leg, found one that closes over both");
      }
    }
  }

  /// Whether a joint may be part of a closed leg: no free joint, wheel or held joint.
  bool is_hinge(int joint) const {
    const auto& wheels = robot_.joint;
    return robot_.mj->jnt_type[joint] != mjJNT_FREE && joint != wheels[2] && joint != wheels[5] &&
           !is_held(robot_, joint);
  }

  /// The hinge that moves a body in its leg, without the wheel; −1 for the base.
  int mover(int body) const {
    for (; body != robot_.base_body && body > 0; body = robot_.mj->body_parentid[body]) {
      if (robot_.mj->body_jntnum[body] == 0) continue;
      if (is_hinge(robot_.mj->body_jntadr[body])) return robot_.mj->body_jntadr[body];
    }
    return -1;
  }

  int root(int joint) const {
    while (above_[static_cast<std::size_t>(joint)] != joint) {
      joint = above_[static_cast<std::size_t>(joint)];
    }
    return joint;
  }

 private:
  int end(int loop, int body) const {
    if (robot_.mj->body_rootid[body] == robot_.base_body) return mover(body);
    source_.fail_at_equality(loop, "expected two bodies of the robot, found the world");
  }

  void unite(int a, int b) {
    if (a >= 0 && b >= 0) above_[static_cast<std::size_t>(root(b))] = root(a);
  }

  const RobotModel& robot_;
  const RobotSource& source_;
  std::vector<int> above_;
};

/// Turns the axis of a hinge to the base's y axis. Loops close in a plane: an axis that is .001 rad
/// off would press 1,800 N into its loop.
void straighten(mjModel& model, const mjData& data, const RobotSource& source, int joint) {
  const Vector3d axis = vector_at(data.xaxis, joint);
  constexpr double most = 1.0;  // degree
  const double off = std::asin(std::min(1.0, std::hypot(axis.x(), axis.z()))) * 180.0 / M_PI;
  if (off > most) {
    source.fail_at_hinge(
        joint, fmt::format("its axis is {:.1f}° off the base's y axis, expected at most {:g}°, as "
                           "its leg has a loop",
                           off, most));
  }
  const double sign = axis.y() < 0.0 ? -1.0 : 1.0;
  const Vector3d own =
      quaternion_at(data.xquat, model.jnt_bodyid[joint]).conjugate() * Vector3d(0.0, sign, 0.0);
  if (off > 0.0) std::copy_n(own.data(), 3, &model.jnt_axis[3 * joint]);
}

/// The joints of a leg that has loops: hip, knee, then all others in the order of the file.
std::vector<int> joints_of(const RobotModel& robot, const Hinges& hinges, std::size_t leg) {
  std::vector<int> joints = {robot.joint[3 * leg], robot.joint[3 * leg + 1]};
  for (int joint = 0; joint < robot.mj->njnt; ++joint) {
    if (!hinges.is_hinge(joint) || hinges.root(joint) != hinges.root(joints[0])) continue;
    if (joint != joints[0] && joint != joints[1]) joints.push_back(joint);
  }
  return joints;
}

/// Whether a joint has a motor, in the file or by the YAML file.
bool has_motor(const RobotModel& robot, const RobotSource& source, std::size_t side, int joint) {
  const std::vector<std::string>& named = source.parts().motors[side];
  const std::string name = name_of(*robot.mj, mjOBJ_JOINT, joint);
  return source.motor_of(joint) >= 0 || std::ranges::count(named, name) > 0;
}

/// Gives a leg its motors, the hip's own first and the knee's own last.
void set_motors(RobotModel& robot, ClosedLeg& leg, std::size_t side, const RobotSource& source) {
  mjModel& model = *robot.mj;
  std::vector<int>& motors = leg.linkage.motors;
  const std::vector<std::string>& named = source.parts().motors[side];
  for (std::size_t i = 0; i < named.size(); ++i) {
    const int joint = mj_name2id(&model, mjOBJ_JOINT, named[i].c_str());
    if (std::ranges::count(leg.joint, joint) > 0) continue;
    source.keys().fail(
        fmt::format("motors.{}.{}", sides[side], i),
        fmt::format("expected a joint of the {} leg's loops, found '{}'", sides[side], named[i]));
  }
  const auto count = static_cast<int>(leg.joint.size());
  for (int place = 0; place < count; ++place) {
    // The knee comes after cranks.
    const int i = place == 0 ? 0 : (place == count - 1 ? 1 : place + 1);
    if (has_motor(robot, source, side, leg.joint[static_cast<std::size_t>(i)])) motors.push_back(i);
  }
  if (motors.empty() || motors.size() > 2) {
    source.fail_at_hinge(
        leg.joint[0],
        fmt::format("expected one or two motors in the {} leg, as it has a loop, found {}",
                    sides[side], motors.size()));
  }
  for (std::size_t i = 0; i < 2; ++i) {
    const std::size_t servo = 3 * side + i;
    robot.motor_joint[servo] = -1;
    robot.effort[servo] = 0.0;
    if (i >= motors.size()) continue;
    const int joint = leg.joint[static_cast<std::size_t>(motors[i])];
    robot.motor_joint[servo] = joint;
    robot.effort[servo] = torque_limit(model, joint, servo, source);
    robot.actuator[servo] = actuator_at(model, model.jnt_dofadr[joint]);
  }
  // Friction is that of motors, in every engine.
  for (const int joint : leg.joint) {
    model.dof_damping[model.jnt_dofadr[joint]] = 0.0;
    model.dof_frictionloss[model.jnt_dofadr[joint]] = 0.0;
  }
}

/// A point of a body seen from the side, moving with its hinge of the leg.
class SideOfLeg {
 public:
  SideOfLeg(const RobotModel& robot, const Hinges& hinges, const ClosedLeg& leg)
      : hinges_(hinges), leg_(leg), data_(at_reference(robot)) {}

  const mjData& data() const { return *data_; }
  int hinge_of(int body) const {
    const int joint = hinges_.mover(body);
    const auto found = std::find(leg_.joint.begin(), leg_.joint.end(), joint);
    return found == leg_.joint.end() ? -1 : static_cast<int>(found - leg_.joint.begin());
  }
  Linkage::Point point(int body, const Vector3d& in_base) const {
    return {hinge_of(body), {in_base.x(), in_base.z()}};
  }
  Vector3d in_base(int body, const mjtNum* in_body) const {
    return vector_at(data_->xpos, body) + quaternion_at(data_->xquat, body) * vector_at(in_body, 0);
  }
  Vector3d in_body(int body, const Vector3d& in_base) const {
    return quaternion_at(data_->xquat, body).conjugate() * (in_base - vector_at(data_->xpos, body));
  }

 private:
  const Hinges& hinges_;
  const ClosedLeg& leg_;
  MjDataPtr data_;
};

void add_hinges(const RobotModel& robot, const SideOfLeg& side, ClosedLeg& leg,
                const RobotSource& source) {
  const mjModel& model = *robot.mj;
  for (const int joint : leg.joint) {
    const int body = model.jnt_bodyid[joint];
    const Vector3d anchor = vector_at(side.data().xanchor, joint);
    const int above = side.hinge_of(model.body_parentid[body]);
    if (above >= static_cast<int>(leg.linkage.hinges.size()) ||
        (leg.linkage.hinges.empty() && above >= 0)) {
      source.fail_at_hinge(joint, "expected hip and knee alone between base and wheel");
    }
    leg.linkage.hinges.push_back({above,
                                  {anchor.x(), anchor.z()},
                                  vector_at(side.data().xaxis, joint).y() > 0.0 ? 1.0 : -1.0,
                                  model.qpos0[model.jnt_qposadr[joint]]});
  }
  for (int body = 1; body < model.nbody; ++body) {
    if (side.hinge_of(body) < 2 || model.body_mass[body] == 0.0) continue;
    leg.linkage.branch.push_back(
        {model.body_mass[body], side.point(body, vector_at(side.data().xipos, body))});
  }
}

/// Adds a loop; in the engines' model, its ends get into one plane.
void add_loop(RobotModel& robot, const SideOfLeg& side, ClosedLeg& leg, int loop,
              const RobotSource& source) {
  mjModel& model = *robot.mj;
  const std::array<int, 2> body = {model.eq_obj1id[loop], model.eq_obj2id[loop]};
  std::array<Vector3d, 2> place;
  for (std::size_t i = 0; i < 2; ++i) {
    mjtNum* const anchor = &model.eq_data[mjNEQDATA * loop + 3 * static_cast<int>(i)];
    place[i] = side.in_base(body[i], anchor);
    for (std::size_t wheel = 0; wheel < wheel_count; ++wheel) {
      const int axle = robot.joint[index(wheel_servos[wheel])];
      if (model.body_weldid[body[i]] != model.body_weldid[model.jnt_bodyid[axle]]) continue;
      Vector3d off = place[i] - vector_at(side.data().xanchor, axle);
      off.y() = 0.0;
      if (off.norm() > 1e-3) source.fail_at_equality(loop, "expected it on the wheel's axle");
    }
  }
  const double sideways = place[1].y() - place[0].y();
  constexpr double most = 5e-3;  // m
  if (std::abs(sideways) > most) {
    source.fail_at_equality(loop,
                            fmt::format("its points are {:.1f} mm apart along the axles, expected "
                                        "at most {:g}",
                                        1e3 * std::abs(sideways), 1e3 * most));
  }
  leg.linkage.loops.push_back({side.point(body[0], place[0]), side.point(body[1], place[1])});
  place[1].y() = place[0].y();
  const Vector3d moved = side.in_body(body[1], place[1]);
  std::copy_n(moved.data(), 3, &model.eq_data[mjNEQDATA * loop + 3]);
  // Closes within .1 mm when the robot lands. Stiffer loops gain nothing at steps of 1 ms.
  constexpr mjtNum solref[mjNREF] = {0.002, 1.0};
  constexpr mjtNum solimp[mjNIMP] = {0.99, 0.999, 0.001, 0.5, 2.0};
  std::copy_n(solref, mjNREF, &model.eq_solref[mjNREF * loop]);
  std::copy_n(solimp, mjNIMP, &model.eq_solimp[mjNIMP * loop]);
  leg.equality.push_back(loop);
}

/// Closes the loops near the pose of the file, where motors are.
void set_start(ClosedLeg& leg, std::size_t side, const RobotSource& source) {
  Linkage& linkage = leg.linkage;
  linkage.start.resize(linkage.size());
  for (Eigen::Index i = 0; i < linkage.size(); ++i) {
    linkage.start[i] = linkage.hinges[static_cast<std::size_t>(i)].reference;
  }
  const LinkageVector gaps = LinkagePose(linkage, linkage.start).gaps();
  std::vector<double> at;
  for (const int motor : linkage.motors) at.push_back(linkage.start[motor]);
  if (!move_linkage(linkage, linkage.motors, at, linkage.start)) {
    source.fail_at_equality(
        leg.equality[0],
        fmt::format("the points of its leg's loops are {:.1f} mm apart in the pose "
                    "of the file, and no pose of the passive joints joins them",
                    1e3 * gaps.lpNorm<Eigen::Infinity>()));
  }
  const int free = mobility(linkage, linkage.start);
  if (free != static_cast<int>(linkage.motors.size())) {
    source.fail_at_hinge(
        leg.joint[0],
        fmt::format("the loops of the {} leg leave {} of its joints free, but {} ha{} a "
                    "motor",
                    sides[side], free, linkage.motors.size(),
                    linkage.motors.size() == 1 ? "s" : "ve"));
  }
}

/// Warns of loops that meet elsewhere in the left leg than in the right, with hinges in one place.
void compare_loops(RobotModel& robot, const RobotSource& source) {
  const ClosedLeg& left = *robot.closed_leg[0];
  const ClosedLeg& right = *robot.closed_leg[1];
  const auto is_apart = [](const auto& a, const auto& b) {
    return (a.place - b.place).norm() > 2e-3;
  };
  if (!std::ranges::equal(left.linkage.hinges, right.linkage.hinges, std::not_fn(is_apart))) return;
  for (std::size_t i = 0; i < std::min(left.equality.size(), right.equality.size()); ++i) {
    const Linkage::Loop& loop = left.linkage.loops[i];
    const Linkage::Loop& other = right.linkage.loops[i];
    if (!is_apart(loop.first, other.first) && !is_apart(loop.second, other.second)) continue;
    robot.warnings.push_back(
        fmt::format("{}: the loop of the left leg meets {:.1f} mm from where that of the mirrored "
                    "leg does: is one anchor wrong?",
                    source.place_of({mjOBJ_EQUALITY, left.equality[i]}),
                    1e3 * std::max((loop.first.place - other.first.place).norm(),
                                   (loop.second.place - other.second.place).norm())));
  }
}

}  // namespace

void find_closed_legs(RobotModel& robot, const RobotSource& source) {
  mjModel& model = *robot.mj;
  if (model.neq == 0) return;
  if (!robot.has(0)) source.fail_at_equality(0, "expected a leg with a hip");
  const Hinges hinges(robot, source);
  const MjDataPtr data = at_reference(robot);
  for (std::size_t side = 0; side < wheel_count; ++side) {
    ClosedLeg leg;
    leg.joint = joints_of(robot, hinges, side);
    if (leg.joint.size() > most_hinges) {
      source.fail_at_hinge(leg.joint.back(),
                           fmt::format("expected at most {} hinges in a leg", most_hinges));
    }
    for (const int joint : leg.joint) {
      source.check_hinge(joint, "as it is in a loop");
      straighten(model, *data, source, joint);
    }
    set_motors(robot, leg, side, source);
    robot.linked.insert(robot.linked.end(), leg.joint.begin() + 2, leg.joint.end());
    robot.closed_leg[side] = std::move(leg);
  }
  for (int joint = 0; joint < model.njnt; ++joint) {
    const bool is_known =
        std::find(robot.linked.begin(), robot.linked.end(), joint) != robot.linked.end() ||
        std::find(robot.joint.begin(), robot.joint.end(), joint) != robot.joint.end();
    if (!hinges.is_hinge(joint) || is_known) continue;
    source.fail_at_hinge(
        joint, "expected it in a loop of one leg (`loops`), or, if it is no rod, under `held`");
  }
}

void measure_closed_legs(RobotModel& robot, const RobotSource& source) {
  if (robot.mj->neq == 0) return;
  const Hinges hinges(robot, source);
  for (std::size_t i = 0; i < wheel_count; ++i) {
    ClosedLeg& leg = *robot.closed_leg[i];
    const SideOfLeg side(robot, hinges, leg);
    add_hinges(robot, side, leg, source);
    for (int loop = 0; loop < robot.mj->neq; ++loop) {
      const int first = side.hinge_of(robot.mj->eq_obj1id[loop]);
      const int second = side.hinge_of(robot.mj->eq_obj2id[loop]);
      if (first < 0 && second < 0) continue;
      if (leg.equality.size() == most_loops) {
        source.fail_at_equality(loop, fmt::format("expected at most {} in a leg", most_loops));
      }
      add_loop(robot, side, leg, loop, source);
    }
    const Vector3d axle = vector_at(side.data().xanchor, robot.joint[index(wheel_servos[i])]);
    leg.linkage.axle = {1, {axle.x(), axle.z()}};
    if (leg.equality.empty()) {
      source.fail_at_hinge(robot.joint[3 * i],
                           "expected loops in both legs, found none in this one");
    }
    set_start(leg, i, source);
  }
  compare_loops(robot, source);
}

}  // namespace touchdown::models
