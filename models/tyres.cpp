#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "models/robot_source.hpp"

namespace touchdown::models {

namespace {

using Eigen::Vector3d;

constexpr std::array<const char*, wheel_count> tyre_names = {"left_tire", "right_tire"};

/// Touchdown's own geoms of a tyre: the sphere of a wheel without a round collider (0), strips.
std::string own_name(std::size_t wheel, std::size_t strip) {
  return fmt::format("{}{}_{}", own_prefix, tyre_names[wheel], strip);
}

std::string tyre_key(std::size_t wheel) {
  return fmt::format("tyres.{}", wheel == 0 ? "left" : "right");
}

int wheel_joint(const RobotModel& robot, std::size_t wheel) {
  return robot.joint[index(wheel_servos[wheel])];
}

bool is_visual(const mjModel& model, int geom) {
  return model.geom_contype[geom] == 0 && model.geom_conaffinity[geom] == 0;
}

void leave_untouched(mjModel& model, int geom) {
  model.geom_contype[geom] = model.geom_conaffinity[geom] = 0;
}

/// Lets the named geoms, and all geoms of the named bodies, touch nothing.
void leave_untouched(mjModel& model, const RobotSource& source) {
  const std::vector<std::string>& names = source.parts().no_collision;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Part part =
        source.named({mjOBJ_GEOM, mjOBJ_BODY}, names[i], fmt::format("no_collision.{}", i));
    for (int geom = 0; geom < model.ngeom; ++geom) {
      const int id = part.type == mjOBJ_GEOM ? geom : model.geom_bodyid[geom];
      if (id == part.id) leave_untouched(model, geom);
    }
  }
}

/// Moves the sphere of a wheel to its axle, abreast of its centre of mass. It alone touches.
int placed_sphere(const RobotModel& robot, std::size_t wheel) {
  mjModel& model = *robot.mj;
  const int sphere = mj_name2id(&model, mjOBJ_GEOM, own_name(wheel, 0).c_str());
  const int body = model.geom_bodyid[sphere];
  for (int geom = 0; geom < model.ngeom; ++geom) {
    if (geom != sphere && is_below(model, model.geom_bodyid[geom], body)) {
      leave_untouched(model, geom);
    }
  }
  const Vector3d anchor = vector_at(model.jnt_pos, wheel_joint(robot, wheel));
  const Vector3d axis = vector_at(model.jnt_axis, wheel_joint(robot, wheel));
  const Vector3d middle = anchor + axis * axis.dot(vector_at(model.body_ipos, body) - anchor);
  std::copy_n(middle.data(), 3, &model.geom_pos[3 * sphere]);
  model.geom_sameframe[sphere] = 0;
  return sphere;
}

/// The largest round collider of a body and of the bodies that are fixed to it.
int largest_round_collider(const mjModel& model, int body, std::size_t wheel,
                           const RobotSource& source) {
  int largest = -1;
  int count = 0;
  for (int geom = 0; geom < model.ngeom; ++geom) {
    const int type = model.geom_type[geom];
    const int on = model.geom_bodyid[geom];
    const bool is_round =
        type == mjGEOM_SPHERE || type == mjGEOM_CYLINDER || type == mjGEOM_CAPSULE;
    if (!is_round || is_visual(model, geom) || !is_below(model, on, body) ||
        model.body_weldid[on] != model.body_weldid[body]) {
      continue;
    }
    const double radius = model.geom_size[3 * geom];
    const double most = largest < 0 ? 0.0 : model.geom_size[3 * largest];
    if (radius > most) largest = geom;
    count = radius > most ? 1 : count + (radius == most ? 1 : 0);
  }
  const auto fail = [&](const char* message) {
    source.fail_at({mjOBJ_BODY, body}, fmt::format("{}: body '{}': {}", tyre_key(wheel),
                                                   name_of(model, mjOBJ_BODY, body), message));
  };
  if (count == 0) {
    fail(
        "expected a sphere, cylinder or capsule as its collider (for a wheel that is a mesh, "
        "'tyres: {radius: …}' in the YAML file)");
  }
  if (count > 1) {
    fail("expected one round collider, found several of the same radius: name the tyre's geom");
  }
  return largest;
}

/// The geom of a tyre.
int tyre_of(const RobotModel& robot, std::size_t wheel, const RobotSource& source) {
  const mjModel& model = *robot.mj;
  const std::string& own = source.parts().tyre[wheel];
  if (source.parts().tyre_radius > 0.0) return placed_sphere(robot, wheel);
  if (own.empty()) {
    const int usual = mj_name2id(&model, mjOBJ_GEOM, tyre_names[wheel]);
    if (usual >= 0) return usual;
  }
  const Part part = own.empty() ? Part{mjOBJ_BODY, model.jnt_bodyid[wheel_joint(robot, wheel)]}
                                : source.named({mjOBJ_GEOM, mjOBJ_BODY}, own, tyre_key(wheel));
  return part.type == mjOBJ_GEOM ? part.id : largest_round_collider(model, part.id, wheel, source);
}

[[noreturn]] void fail_at_tyre(const RobotModel& robot, const RobotSource& source,
                               std::size_t wheel, const std::string& message) {
  const Part tyre = {mjOBJ_GEOM, robot.tyre_geom[wheel]};
  const std::string name = name_of(*robot.mj, mjOBJ_GEOM, tyre.id);
  const std::size_t servo = index(wheel_servos[wheel]);
  source.fail_at(tyre, fmt::format("{}: {}",
                                   name.empty() || name.starts_with(own_prefix)
                                       ? fmt::format("tyre of joint '{}'", robot.joint_name[servo])
                                       : fmt::format("geom '{}'", name),
                                   message));
}

std::string text_of(const Vector3d& v) {
  const auto rounded = [](double x) { return std::round(1e3 * x) / 1e3 + 0.0; };
  return fmt::format("({:g} {:g} {:g})", rounded(v.x()), rounded(v.y()), rounded(v.z()));
}

/// Checks that a tyre is round about its wheel's axle.
void check_axle(const RobotModel& robot, const RobotSource& source, std::size_t wheel) {
  const mjModel& model = *robot.mj;
  const int geom = robot.tyre_geom[wheel];
  const MjDataPtr data = at_reference(robot);
  const int joint = wheel_joint(robot, wheel);
  const Vector3d axle = vector_at(data->xaxis, joint);
  const double radius = model.geom_size[3 * geom];
  const Vector3d arm = vector_at(data->geom_xpos, geom) - vector_at(data->xanchor, joint);
  constexpr double off = 0.02;        // of the radius: a wheel that is out of true
  constexpr double parallel = 0.999;  // cosine
  const double off_axle = (arm - axle * axle.dot(arm)).norm();
  if (off_axle > off * radius) {
    fail_at_tyre(robot, source, wheel,
                 fmt::format("expected its centre on its wheel's axle, found it {:g} mm beside",
                             std::round(1e4 * off_axle) / 10.0));
  }
  if (model.geom_type[geom] == mjGEOM_SPHERE) return;
  const mjtNum* m = &data->geom_xmat[9 * geom];
  const Vector3d own(m[2], m[5], m[8]);
  if (std::abs(own.dot(axle)) < parallel) {
    fail_at_tyre(robot, source, wheel,
                 fmt::format("its axis in the base is {}, expected that of its wheel's joint, {}",
                             text_of(own), text_of(axle)));
  }
}

}  // namespace

void add_spheres(MjcfDocument& document, const PartNames& parts) {
  for (std::size_t wheel = 0; parts.tyre_radius > 0.0 && wheel < wheel_count; ++wheel) {
    const std::size_t servo = index(wheel_servos[wheel]);
    const std::string_view own = parts.joint[servo];
    const tinyxml2::XMLElement* const joint =
        document.find("joint", own.empty() ? servo_names[servo] : own);
    if (joint == nullptr) continue;  // the compiled model has the complaint
    const tinyxml2::XMLElement& body = *joint->Parent()->ToElement();
    const int group = body.FirstChildElement("geom") != nullptr ? 3 : 0;
    document.insert_last(body,
                         fmt::format("<geom name=\"{}\" type=\"sphere\" size=\"{}\" pos=\"0 0 0\" "
                                     "quat=\"1 0 0 0\" mass=\"0\" group=\"{}\" contype=\"1\" "
                                     "conaffinity=\"1\"/>",
                                     own_name(wheel, 0), parts.tyre_radius, group));
  }
}

void find_tyres(RobotModel& robot, const RobotSource& source) {
  const mjModel& model = *robot.mj;
  leave_untouched(*robot.mj, source);
  for (std::size_t i = 0; i < wheel_count; ++i) {
    const int geom = robot.tyre_geom[i] = tyre_of(robot, i, source);
    if (model.body_weldid[model.geom_bodyid[geom]] != model.jnt_bodyid[wheel_joint(robot, i)]) {
      fail_at_tyre(robot, source, i,
                   fmt::format("expected it on the body that '{}' moves",
                               servo_names[index(wheel_servos[i])]));
    }
    const int type = model.geom_type[geom];
    if (type != mjGEOM_SPHERE && type != mjGEOM_CYLINDER && type != mjGEOM_CAPSULE) {
      fail_at_tyre(robot, source, i, "expected a sphere, a cylinder or a capsule");
    }
    if (robot.tyre.strips().size() > 1 && type != mjGEOM_SPHERE) {
      fail_at_tyre(robot, source, i, "expected a sphere, as the tyre has a width");
    }
    robot.tyre_strips[i] = {geom};
    check_axle(robot, source, i);
    const double radius = model.geom_size[3 * geom];
    constexpr double close = 1e-6;
    if (i > 0 && std::abs(radius - robot.wheel_radius) > close * radius) {
      fail_at_tyre(robot, source, i,
                   fmt::format("expected the radius of the other tyre, {:g} m, found {:g}",
                               robot.wheel_radius, radius));
    }
    robot.wheel_radius = radius;
  }
}

void add_strips(MjcfDocument& document, const RobotModel& robot, const RobotSource& source) {
  const mjModel& model = *robot.mj;
  const std::vector<double> strips = robot.tyre.strips();
  for (std::size_t wheel = 0; wheel < wheel_count; ++wheel) {
    const int tyre = robot.tyre_geom[wheel];
    const Vector3d middle = vector_at(model.geom_pos, tyre);
    const Vector3d axle = vector_at(model.jnt_axis, wheel_joint(robot, wheel));
    std::string spheres;
    for (std::size_t strip = 1; strip < strips.size(); ++strip) {
      const Vector3d at = middle + strips[strip] * axle;
      spheres += fmt::format(
          "<geom name=\"{}\" type=\"sphere\" size=\"{}\" pos=\"{} {} {}\" mass=\"0\" group=\"{}\" "
          "contype=\"{}\" conaffinity=\"{}\" condim=\"{}\" margin=\"0\" gap=\"0\" priority=\"0\"/>",
          own_name(wheel, strip), model.geom_size[3 * tyre], at.x(), at.y(), at.z(),
          model.geom_group[tyre], model.geom_contype[tyre], model.geom_conaffinity[tyre],
          model.geom_condim[tyre]);
    }
    const tinyxml2::XMLElement& element = *source.element_of({mjOBJ_GEOM, tyre});
    std::string_view(element.Name()) == "geom" ? document.insert_before(element, spheres)
                                               : document.insert_last(element, spheres);
  }
}

void find_strips(RobotModel& robot) {
  for (std::size_t wheel = 0; wheel < wheel_count; ++wheel) {
    for (std::size_t strip = 1; strip < robot.tyre.strips().size(); ++strip) {
      robot.tyre_strips[wheel].push_back(
          mj_name2id(robot.mj.get(), mjOBJ_GEOM, own_name(wheel, strip).c_str()));
    }
  }
}

}  // namespace touchdown::models
