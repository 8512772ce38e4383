#include "models/contract/tyres.hpp"

#include <cmath>

#include <fmt/format.h>

namespace touchdown::models {

namespace {

constexpr std::array<const char*, wheel_count> tyre_names = {"left_tire", "right_tire"};

std::string strip_name(std::size_t wheel, std::size_t strip) {
  return fmt::format("touchdown_{}_{}", tyre_names[wheel], strip);
}

/// A tyre in messages: its geom, or the joint of its wheel.
std::string title_of_tyre(const Contract& contract, std::size_t wheel) {
  const std::string& own = contract.parts().tyre[wheel];
  const std::string& joint = contract.parts().joint[index(wheel_servos[wheel])];
  if (own.empty() && !joint.empty()) return fmt::format("tyre of joint '{}'", joint);
  return fmt::format("geom '{}'", own.empty() ? tyre_names[wheel] : own);
}

[[noreturn]] void fail_at_tyre(const Contract& contract, std::size_t wheel,
                               const std::string& message) {
  contract.fail_at_geom(contract.find(mjOBJ_GEOM, "geom", tyre_names[wheel]),
                        fmt::format("{}: {}", title_of_tyre(contract, wheel), message));
}

std::string text_of(const Eigen::Vector3d& v) {
  const auto rounded = [](double x) { return std::round(1e3 * x) / 1e3 + 0.0; };
  return fmt::format("({:g} {:g} {:g})", rounded(v.x()), rounded(v.y()), rounded(v.z()));
}

/// Checks that a tyre is round about its wheel's axle.
void check_axle(const RobotModel& robot, const Contract& contract, std::size_t wheel) {
  const mjModel& model = *robot.mj;
  const int geom = robot.tyre_geom[wheel];
  const MjDataPtr data = at_reference(robot);
  const int joint = robot.joint[index(wheel_servos[wheel])];
  const Eigen::Vector3d axle = vector_at(data->xaxis, joint);
  const double radius = model.geom_size[3 * geom];
  const Eigen::Vector3d arm = vector_at(data->geom_xpos, geom) - vector_at(data->xanchor, joint);
  constexpr double off = 0.02;        // of the radius: a wheel that is out of true
  constexpr double parallel = 0.999;  // cosine
  const double off_axle = (arm - axle * axle.dot(arm)).norm();
  if (off_axle > off * radius) {
    fail_at_tyre(contract, wheel,
                 fmt::format("expected its centre on its wheel's axle, found it {:g} mm beside",
                             std::round(1e4 * off_axle) / 10.0));
  }
  if (model.geom_type[geom] == mjGEOM_SPHERE) return;
  const mjtNum* m = &data->geom_xmat[9 * geom];
  const Eigen::Vector3d own(m[2], m[5], m[8]);
  if (std::abs(own.dot(axle)) < parallel) {
    fail_at_tyre(contract, wheel,
                 fmt::format("its axis in the base is {}, expected that of its wheel's joint, {}",
                             text_of(own), text_of(axle)));
  }
}

}  // namespace

void find_tyres(RobotModel& robot, const Contract& contract) {
  const mjModel& model = *robot.mj;
  for (std::size_t i = 0; i < wheel_count; ++i) {
    const int geom = contract.find(mjOBJ_GEOM, "geom", tyre_names[i]);
    const int joint = robot.joint[index(wheel_servos[i])];
    if (model.body_weldid[model.geom_bodyid[geom]] != model.jnt_bodyid[joint]) {
      fail_at_tyre(contract, i,
                   fmt::format("expected it on the body that '{}' moves",
                               servo_names[index(wheel_servos[i])]));
    }
    const int type = model.geom_type[geom];
    if (type != mjGEOM_SPHERE && type != mjGEOM_CYLINDER && type != mjGEOM_CAPSULE) {
      fail_at_tyre(contract, i, "expected a sphere, a cylinder or a capsule");
    }
    if (robot.tyre.strips().size() > 1 && type != mjGEOM_SPHERE) {
      fail_at_tyre(contract, i, "expected a sphere, as the tyre has a width");
    }
    robot.tyre_geom[i] = geom;
    robot.tyre_strips[i] = {geom};
    check_axle(robot, contract, i);
    const double radius = model.geom_size[3 * geom];
    constexpr double close = 1e-6;
    if (i > 0 && std::abs(radius - robot.wheel_radius) > close * radius) {
      fail_at_tyre(contract, i,
                   fmt::format("expected the radius of the other tyre, {:g} m, found {:g}",
                               robot.wheel_radius, radius));
    }
    robot.wheel_radius = radius;
  }
}

void add_strips(MjcfDocument& document, const RobotModel& robot) {
  const mjModel& model = *robot.mj;
  const std::vector<double> strips = robot.tyre.strips();
  for (std::size_t wheel = 0; wheel < wheel_count; ++wheel) {
    const int tyre = robot.tyre_geom[wheel];
    const Eigen::Vector3d middle = vector_at(model.geom_pos, tyre);
    const Eigen::Vector3d axle = vector_at(model.jnt_axis, robot.joint[index(wheel_servos[wheel])]);
    std::string spheres;
    for (std::size_t strip = 1; strip < strips.size(); ++strip) {
      const Eigen::Vector3d at = middle + strips[strip] * axle;
      spheres += fmt::format(
          "<geom name=\"{}\" type=\"sphere\" size=\"{}\" pos=\"{} {} {}\" mass=\"0\" group=\"{}\" "
          "contype=\"{}\" conaffinity=\"{}\" condim=\"{}\" margin=\"0\" gap=\"0\" priority=\"0\"/>",
          strip_name(wheel, strip), model.geom_size[3 * tyre], at.x(), at.y(), at.z(),
          model.geom_group[tyre], model.geom_contype[tyre], model.geom_conaffinity[tyre],
          model.geom_condim[tyre]);
    }
    document.insert_before(*document.find("geom", tyre_names[wheel]), spheres);
  }
}

void find_strips(RobotModel& robot, const Contract& contract) {
  for (std::size_t wheel = 0; wheel < wheel_count; ++wheel) {
    for (std::size_t strip = 1; strip < robot.tyre.strips().size(); ++strip) {
      robot.tyre_strips[wheel].push_back(
          contract.find(mjOBJ_GEOM, "geom", strip_name(wheel, strip)));
    }
  }
}

}  // namespace touchdown::models
