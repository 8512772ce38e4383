#include "models/contract.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/yaml.hpp"
#include "models/mjcf/parts.hpp"

namespace touchdown::models {

int Contract::find(mjtObj type, const char* tag, std::string_view name) const {
  const int id = mj_name2id(&model_, type, std::string(name).c_str());
  if (id >= 0) return id;
  const std::vector<std::string> names =
      type == mjOBJ_ACTUATOR ? names_of(document_, {"motor", "general", "position", "velocity"})
                             : names_of(document_, {tag});
  fail(fmt::format("expected a {} named '{}'{}", tag, name, found_text(name, names)));
}

const tinyxml2::XMLElement* Contract::body_element(int body) const {
  // MuJoCo numbers bodies in the order of the file, a parent before its children.
  const tinyxml2::XMLElement* found = nullptr;
  int count = 0;
  document_.visit([&](const tinyxml2::XMLElement& element) {
    if (std::string_view(element.Name()) == "body" && ++count == body) found = &element;
  });
  const char* const name = mj_id2name(&model_, mjOBJ_BODY, body);
  const bool is_same =
      found != nullptr && attribute(*found, "name") == (name == nullptr ? "" : name);
  return is_same ? found : nullptr;
}

const tinyxml2::XMLElement* Contract::child(int body, int number,
                                            std::initializer_list<std::string_view> tags) const {
  const tinyxml2::XMLElement* const parent = body_element(body);
  if (parent == nullptr) return nullptr;
  for (auto* e : children(*parent)) {
    const bool is_one = std::find(tags.begin(), tags.end(), e->Name()) != tags.end();
    if (is_one && number-- == 0) return e;
  }
  return parent;
}

void Contract::fail_at(const tinyxml2::XMLElement* element, const std::string& message) const {
  document_.fail(element == nullptr ? document_.root() : *element, message);
}

void Contract::fail(const std::string& message) const {
  const tinyxml2::XMLElement* base = nullptr;
  for (int joint = 0; joint < model_.njnt && base == nullptr; ++joint) {
    if (model_.jnt_type[joint] == mjJNT_FREE) base = body_element(model_.jnt_bodyid[joint]);
  }
  fail_at(base, message);
}

void Contract::fail_at_body(int body, const std::string& message) const {
  fail_at(body_element(body), message);
}

void Contract::fail_at_joint(int joint, const std::string& message) const {
  const int body = model_.jnt_bodyid[joint];
  fail_at(child(body, joint - model_.body_jntadr[body], {"joint", "freejoint"}), message);
}

void Contract::fail_at_geom(int geom, const std::string& message) const {
  const int body = model_.geom_bodyid[geom];
  fail_at(child(body, geom - model_.body_geomadr[body], {"geom"}), message);
}

void Contract::fail_at_site(int site, const std::string& message) const {
  const char* const name = mj_id2name(&model_, mjOBJ_SITE, site);
  fail_at(document_.find("site", name == nullptr ? "" : name), message);
}

const tinyxml2::XMLElement* Contract::section_element(const char* tag, int number) const {
  const auto all = in_sections(document_.root(), tag);
  return static_cast<std::size_t>(number) < all.size() ? all[static_cast<std::size_t>(number)]
                                                       : nullptr;
}

std::string Contract::place_in_section(const char* tag, int number) const {
  const tinyxml2::XMLElement* const found = section_element(tag, number);
  return document_.place_of(found == nullptr ? document_.root() : *found);
}

void Contract::fail_at_actuator(int actuator, const std::string& message) const {
  fail_at(section_element("actuator", actuator), message);
}

void Contract::fail_at_equality(int equality, const std::string& message) const {
  const tinyxml2::XMLElement* const found = section_element("equality", equality);
  fail_at(found, fmt::format("{}: {}", found == nullptr ? "connect" : title_of(*found), message));
}

void Contract::fail_at_hinge(int joint, const std::string& message) const {
  fail_at_joint(joint, fmt::format("joint {}: {}", name_of(mjOBJ_JOINT, joint), message));
}

void Contract::fail_at_servo(std::size_t servo, const std::string& message) const {
  fail_at_hinge(find(mjOBJ_JOINT, "joint", servo_names[servo]), message);
}

void Contract::check_hinge(int joint, std::string_view as_it_is) const {
  if (model_.jnt_type[joint] != mjJNT_HINGE) {
    fail_at_hinge(joint, fmt::format("expected a hinge, {}", as_it_is));
  }
  if (model_.body_jntnum[model_.jnt_bodyid[joint]] > 1) {
    fail_at_hinge(joint, fmt::format("expected no other joint on its body, {}", as_it_is));
  }
  if (const double stiffness = model_.jnt_stiffness[joint]; stiffness != 0.0) {
    fail_at_hinge(joint, fmt::format("expected no spring, found stiffness {:g}", stiffness));
  }
}

std::string Contract::name_of(mjtObj type, int id) const {
  if (const char* const name = mj_id2name(&model_, type, id); name != nullptr && *name != '\0') {
    for (std::size_t i = 0; i < servo_count; ++i) {
      if (type == mjOBJ_JOINT && name == servo_names[i]) {
        return fmt::format("'{}'", own_name(parts_, i));
      }
    }
    for (std::size_t i = 0; i < parts_.held.size(); ++i) {
      if (type == mjOBJ_JOINT && name == held_name(i)) return fmt::format("'{}'", parts_.held[i]);
    }
    return fmt::format("'{}'", name);
  }
  const int body = type == mjOBJ_GEOM ? model_.geom_bodyid[id] : model_.jnt_bodyid[id];
  const char* const name = mj_id2name(&model_, mjOBJ_BODY, body);
  return fmt::format("without a name on body '{}'", name == nullptr ? "" : name);
}

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
