#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "models/resizing.hpp"
#include "models/robot_source.hpp"

namespace touchdown::models {

namespace {

using Eigen::Vector3d;

/// The sign of the y axis about which a servo turns in touchdown's convention.
double expected_sign(std::size_t servo) {
  const double leg = servo < 3 ? -1.0 : 1.0;
  return servo % 3 == 2 ? -leg : leg;
}

/// The sign that makes a hip's or knee's angle positive forward.
double forward_sign(std::size_t servo) { return servo < 3 ? 1.0 : -1.0; }

void check_axis(const RobotModel& robot, const Vector3d& axis, std::size_t servo,
                const RobotSource& source) {
  constexpr double least = 0.97;  // cosine of 14°
  if (std::abs(axis.y()) >= least) return;
  const auto rounded = [](double x) { return std::round(1e3 * x) / 1e3 + 0.0; };
  source.fail_at_hinge(
      robot.joint[servo],
      fmt::format("its axis in the base is ({:g} {:g} {:g}), expected (0 {:g} 0) or its "
                  "opposite: x is forward, y left, z up",
                  rounded(axis.x()), rounded(axis.y()), rounded(axis.z()), expected_sign(servo)));
}

void check_chain(const RobotModel& robot, const RobotSource& source) {
  const mjModel& model = *robot.mj;
  for (std::size_t i = 0; i < servo_count; ++i) {
    if (i % 3 == 2 || !robot.has(i)) continue;
    const int above = model.jnt_bodyid[robot.joint[i]];
    const int below = model.jnt_bodyid[robot.joint[i + 1]];
    if (above != below && is_below(model, below, above)) continue;
    source.fail_at_hinge(
        robot.joint[i + 1],
        fmt::format("expected it below joint '{}': each leg is one open chain", servo_names[i]));
  }
}

/// Turns a joint's axis around, so that its angles change their sign.
void reverse(mjModel& model, int joint) {
  for (int k = 0; k < 3; ++k) {
    // Adding zero avoids −0, which some products would carry on.
    model.jnt_axis[3 * joint + k] = -model.jnt_axis[3 * joint + k] + 0.0;
  }
  mjtNum* const range = &model.jnt_range[2 * joint];
  const mjtNum low = range[0];
  range[0] = -range[1] + 0.0;
  range[1] = -low + 0.0;
  const int address = model.jnt_qposadr[joint];
  model.qpos0[address] = -model.qpos0[address] + 0.0;
  model.qpos_spring[address] = -model.qpos_spring[address] + 0.0;
}

/// The forward angle of a link from straight down, seen from the side (rad).
double angle_of(const Vector3d& link) { return std::atan2(link.x(), -link.z()); }

/// Lets a joint have the angle `straight` at the reference pose. Whole turns are chosen so that the
/// joint's range is around zero.
void set_reference(RobotModel& robot, std::size_t servo, double angle) {
  mjModel& model = *robot.mj;
  const int joint = robot.joint[servo];
  mjtNum& reference = model.qpos0[robot.qpos_address[servo]];
  mjtNum* const range = &model.jnt_range[2 * joint];
  constexpr double none = 1e-9;
  if (std::abs(angle) < none) angle = 0.0;
  double shift = angle - reference;
  constexpr double turn = 2.0 * std::numbers::pi;
  if (model.jnt_limited[joint] != 0) {
    const double middle = 0.5 * (range[0] + range[1]) + shift;
    shift -= turn * std::round(middle / turn);
  }
  if (shift == 0.0) return;
  reference += shift;
  range[0] += shift;
  range[1] += shift;
  robot.zero[servo] = shift;
}

/// Moves the zeros of hips and knees to straight legs, and those of the wheels to no `ref`.
void set_zeros(RobotModel& robot, const RobotSource& source) {
  const MjDataPtr data = at_reference(robot);
  for (std::size_t leg = 0; leg < wheel_count; ++leg) {
    const std::size_t hip = 3 * leg;
    const auto anchor = [&](std::size_t servo) {
      return vector_at(data->xanchor, robot.joint[servo]);
    };
    double above = 0.0;
    for (std::size_t servo = robot.has(hip) ? hip : hip + 1; servo < hip + 2; ++servo) {
      const Vector3d link = anchor(servo + 1) - anchor(servo);
      constexpr double shortest = 1e-3;  // m
      if (std::hypot(link.x(), link.z()) < shortest) {
        source.fail_at_hinge(robot.joint[servo + 1],
                             "expected it away from the joint above it, seen from the side");
      }
      const double angle = angle_of(link);
      set_reference(robot, servo, forward_sign(servo) * (angle - above));
      above = angle;
    }
    set_reference(robot, hip + 2, 0.0);
  }
}

void set_contacts(RobotModel& robot, const RobotSource& source) {
  mjModel& model = *robot.mj;
  for (int geom = 0; geom < model.ngeom; ++geom) {
    if (model.body_rootid[model.geom_bodyid[geom]] != robot.base_body) continue;
    const bool is_tyre = std::any_of(
        robot.tyre_strips.begin(), robot.tyre_strips.end(), [&](const std::vector<int>& strips) {
          return std::find(strips.begin(), strips.end(), geom) != strips.end();
        });
    if (!is_tyre && model.geom_contype[geom] == 0 && model.geom_conaffinity[geom] == 0) continue;
    const int type = model.geom_type[geom];
    if (type == mjGEOM_ELLIPSOID || type == mjGEOM_HFIELD || type == mjGEOM_PLANE) {
      const Part part = {mjOBJ_GEOM, geom};
      source.fail_at(part, fmt::format("geom {}: expected a sphere, capsule, cylinder, box or "
                                       "mesh: Bullet has no counterpart of this shape",
                                       source.title_of(part)));
    }
    model.geom_contype[geom] = robot_contype;
    model.geom_conaffinity[geom] = robot_conaffinity;
    model.geom_margin[geom] = model.geom_gap[geom] = 0.0;
    model.geom_priority[geom] = 0;
  }
}

/// MuJoCo's default softness of joint limits, and no margin.
void set_limits(mjModel& model) {
  constexpr mjtNum solref[mjNREF] = {0.02, 1.0};
  constexpr mjtNum solimp[mjNIMP] = {0.9, 0.95, 0.001, 0.5, 2.0};
  for (int joint = 0; joint < model.njnt; ++joint) {
    std::copy_n(solref, mjNREF, &model.jnt_solref[mjNREF * joint]);
    std::copy_n(solimp, mjNIMP, &model.jnt_solimp[mjNIMP * joint]);
    model.jnt_margin[joint] = 0.0;
  }
}

/// The axis of the base that faces forward, across the wheels' axes.
std::string forward_axis(const RobotModel& robot) {
  const MjDataPtr data = at_reference(robot);
  const Vector3d axle = vector_at(data->xaxis, robot.joint[index(wheel_servos[0])]);
  constexpr double least = 0.97;  // cosine of 14°
  if (std::abs(axle.x()) < least) return "x";
  const double left = data->geom_xpos[3 * robot.tyre_geom[0]];
  return left > data->geom_xpos[3 * robot.tyre_geom[1]] ? "-y" : "y";
}

}  // namespace

bool is_below(const mjModel& model, int below, int above) {
  for (int body = below; body > 0; body = model.body_parentid[body]) {
    if (body == above) return true;
  }
  return false;
}

std::string turn_base(RobotModel& robot, std::string_view given) {
  std::string forward = given == "auto" ? forward_axis(robot) : std::string(given);
  if (forward == "x") return forward;
  const double half = std::numbers::sqrt2 / 2.0;
  const Eigen::Quaterniond turn = forward == "-x"  ? Eigen::Quaterniond(0.0, 0.0, 0.0, 1.0)
                                  : forward == "y" ? Eigen::Quaterniond(half, 0.0, 0.0, -half)
                                                   : Eigen::Quaterniond(half, 0.0, 0.0, half);
  mjModel& model = *robot.mj;
  /// Turns what is on the base, by rows of MuJoCo's arrays.
  const auto turn_those = [&](int count, const int* body, mjtNum* position, mjtNum* orientation) {
    for (int row = 0; row < count; ++row) {
      if (body[row] != robot.base_body) continue;
      const Vector3d at = turn * vector_at(position, row);
      const Eigen::Quaterniond as = turn * quaternion_at(orientation, row);
      std::copy_n(at.data(), 3, position + 3 * row);
      set_quaternion(orientation, row, as);
    }
  };
  const int base = robot.base_body;
  turn_those(1, &base, &model.body_ipos[3 * base], &model.body_iquat[4 * base]);
  turn_those(model.nbody, model.body_parentid, model.body_pos, model.body_quat);
  turn_those(model.ngeom, model.geom_bodyid, model.geom_pos, model.geom_quat);
  turn_those(model.nsite, model.site_bodyid, model.site_pos, model.site_quat);
  for (int loop = 0; loop < model.neq; ++loop) {
    mjtNum* const anchor = &model.eq_data[mjNEQDATA * loop];
    for (const bool is_first : {true, false}) {
      if ((is_first ? model.eq_obj1id : model.eq_obj2id)[loop] != base) continue;
      const Vector3d at = turn * vector_at(anchor, is_first ? 0 : 1);
      std::copy_n(at.data(), 3, anchor + (is_first ? 0 : 3));
    }
  }
  turn_those(model.ncam, model.cam_bodyid, model.cam_pos, model.cam_quat);
  // Frames may differ now that MuJoCo took for the same.
  std::fill_n(model.body_sameframe, model.nbody, mjtByte{0});
  std::fill_n(model.geom_sameframe, model.ngeom, mjtByte{0});
  std::fill_n(model.site_sameframe, model.nsite, mjtByte{0});
  recompute(model);
  return forward;
}

void order_sides(RobotModel& robot, const RobotSource& source) {
  const MjDataPtr data = at_reference(robot);
  const double left = vector_at(data->geom_xpos, robot.tyre_geom[0]).y();
  const double right = vector_at(data->geom_xpos, robot.tyre_geom[1]).y();
  if (std::abs(left - right) < 0.5 * robot.wheel_radius) {
    source.fail_at({mjOBJ_GEOM, robot.tyre_geom[1]},
                   "expected the tyres side by side, the left one at larger y");
  }
  if (left > right) return;
  const auto swap = [](auto& of_servos) {
    std::swap_ranges(of_servos.begin(), of_servos.begin() + 3, of_servos.begin() + 3);
  };
  swap(robot.joint);
  swap(robot.joint_name);
  swap(robot.qpos_address);
  swap(robot.dof_address);
  swap(robot.motor_joint);
  swap(robot.effort);
  swap(robot.actuator);
  std::swap(robot.tyre_geom[0], robot.tyre_geom[1]);
  std::swap(robot.tyre_strips[0], robot.tyre_strips[1]);
}

void find_imu(RobotModel& robot, const RobotSource& source) {
  const mjModel& model = *robot.mj;
  const std::string& given = source.parts().imu;
  Part imu = {mjOBJ_SITE, mj_name2id(&model, mjOBJ_SITE, "imu")};
  if (given.empty() && imu.id < 0) imu = {mjOBJ_BODY, mj_name2id(&model, mjOBJ_BODY, "imu")};
  if (!given.empty()) imu = source.named({mjOBJ_SITE, mjOBJ_BODY}, given, "imu");
  if (imu.id < 0) {
    source.fail(fmt::format("expected a site named 'imu'{}",
                            found_text("imu", names_of(model, mjOBJ_SITE))) +
                "; a YAML file about the robot can name another, as `touchdown check FILE --write "
                "robot.yaml` does");
  }
  const int body = imu.type == mjOBJ_SITE ? model.site_bodyid[imu.id] : imu.id;
  if (model.body_weldid[body] != model.body_weldid[robot.base_body]) {
    source.fail_at(imu, "site 'imu': expected it on the base body");
  }
  const MjDataPtr data = at_reference(robot);
  robot.imu_position = vector_at(imu.type == mjOBJ_SITE ? data->site_xpos : data->xpos, imu.id);
}

void apply_conventions(RobotModel& robot, const RobotSource& source) {
  mjModel& model = *robot.mj;
  check_chain(robot, source);
  const MjDataPtr data = at_reference(robot);
  for (std::size_t i = 0; i < servo_count; ++i) {
    if (!robot.has(i)) continue;
    const Vector3d axis = vector_at(data->xaxis, robot.joint[i]);
    check_axis(robot, axis, i, source);
    if (axis.y() * expected_sign(i) > 0.0) continue;
    reverse(model, robot.joint[i]);
    robot.is_reversed[i] = true;
  }
  set_zeros(robot, source);
  set_contacts(robot, source);
  set_limits(model);
}

}  // namespace touchdown::models
