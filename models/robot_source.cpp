#include "models/robot_source.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"

namespace touchdown::models {

namespace {

/// The tag of an element in an MJCF.
const char* tag_of(mjtObj type) { return type == mjOBJ_XBODY ? "body" : mju_type2Str(type); }

}  // namespace

std::vector<std::string> names_of(const mjModel& model, mjtObj type) {
  const int count = type == mjOBJ_JOINT  ? model.njnt
                    : type == mjOBJ_GEOM ? model.ngeom
                    : type == mjOBJ_SITE ? model.nsite
                                         : model.nbody;
  std::vector<std::string> names;
  for (int id = type == mjOBJ_BODY ? 1 : 0; id < count; ++id) {
    const std::string name = name_of(model, type, id);
    if (!name.empty() && !name.starts_with(own_prefix)) names.push_back(name);
  }
  return names;
}

bool is_held(const RobotModel& robot, int joint) {
  return std::ranges::any_of(robot.held,
                             [&](const HeldJoint& held) { return held.joint == joint; });
}

std::string name_of(const mjModel& model, mjtObj type, int id) {
  const char* const text = mj_id2name(&model, type, id);
  return text == nullptr ? "" : text;
}

Part RobotSource::named(std::initializer_list<mjtObj> types, const std::string& name,
                        std::string_view key) const {
  std::vector<std::string> titles;
  std::vector<std::string> names;
  for (const mjtObj type : types) {
    const int id = mj_name2id(&model_, type, name.c_str());
    if (id >= 0) return {type, id};
    titles.push_back(fmt::format("a {}", tag_of(type)));
    for (std::string& other : names_of(model_, type)) names.push_back(std::move(other));
  }
  keys_.fail(key, fmt::format("expected {} named '{}' in {}{}", fmt::join(titles, " or "), name,
                              robot_.document.file().filename().string(), found_text(name, names)));
}

int RobotSource::joint(const std::string& name, std::string_view key) const {
  if (std::ranges::count(robot_.fixed, name) > 0) {
    keys_.fail(key, fmt::format("joint '{}' is fixed, expected a hinge", name));
  }
  return named({mjOBJ_JOINT}, name, key).id;
}

int RobotSource::joint_of(int motor) const {
  const int kind = model_.actuator_trntype[motor];
  const bool drives_joint = kind == mjTRN_JOINT || kind == mjTRN_JOINTINPARENT;
  return drives_joint ? model_.actuator_trnid[2 * motor] : -1;
}

int RobotSource::motor_of(int joint) const {
  for (int i = 0; i < model_.nu; ++i) {
    if (joint_of(i) == joint) return i;
  }
  return -1;
}

double RobotSource::limit_of(int joint) const {
  const int columns = model_.nuser_jnt;
  const mjtNum* const range = &model_.jnt_user[columns * joint];
  const bool has_range = columns > 1 && (range[0] != 0.0 || range[1] != 0.0);
  const auto symmetric = [](double low, double high) {
    constexpr double close = 1e-6;
    return high > 0.0 && std::abs(low + high) <= close * high;
  };
  if (has_range && !symmetric(range[0], range[1])) {
    fail_at_hinge(joint, fmt::format("actuatorfrcrange: expected a symmetric range, found {:g} to "
                                     "{:g}",
                                     range[0], range[1]));
  }
  const auto found = robot_.effort.find(name_of(model_, mjOBJ_JOINT, joint));
  return has_range                      ? range[1]
         : found == robot_.effort.end() ? std::numeric_limits<double>::infinity()
                                        : found->second;
}

void RobotSource::fail(const std::string& message) const {
  for (int joint = 0; joint < model_.njnt; ++joint) {
    if (model_.jnt_type[joint] == mjJNT_FREE) {
      fail_at({mjOBJ_BODY, model_.jnt_bodyid[joint]}, message);
    }
  }
  robot_.document.fail(robot_.document.root(), message);
}

void RobotSource::fail_at(Part part, const std::string& message) const {
  throw InputError(fmt::format("{}: {}", place_of(part), message));
}

void RobotSource::fail_at_hinge(int joint, const std::string& message) const {
  const Part part = {mjOBJ_JOINT, joint};
  fail_at(part, fmt::format("joint {}: {}", title_of(part), message));
}

void RobotSource::fail_at_equality(int equality, const std::string& message) const {
  const std::string name = name_of(model_, mjOBJ_EQUALITY, equality);
  fail_at({mjOBJ_EQUALITY, equality},
          fmt::format("connect{}: {}", name.empty() ? "" : " '" + name + "'", message));
}

void RobotSource::check_hinge(int joint, std::string_view as_it_is) const {
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

int RobotSource::body_of(Part part) const {
  switch (part.type) {
    case mjOBJ_JOINT:
      return model_.jnt_bodyid[part.id];
    case mjOBJ_GEOM:
      return model_.geom_bodyid[part.id];
    case mjOBJ_SITE:
      return model_.site_bodyid[part.id];
    case mjOBJ_EQUALITY:
      return model_.eq_obj2id[part.id];
    default:
      return part.id;
  }
}

std::string RobotSource::title_of(Part part) const {
  const std::string name = name_of(model_, part.type, part.id);
  if (!name.empty()) return fmt::format("'{}'", name);
  return fmt::format("without a name on body '{}'", name_of(model_, mjOBJ_BODY, body_of(part)));
}

tinyxml2::XMLElement* RobotSource::element_of(Part part) const {
  const MjcfDocument& document = robot_.document;
  const bool is_equality = part.type == mjOBJ_EQUALITY;
  if (is_equality || part.type == mjOBJ_ACTUATOR) {
    const auto all = in_sections(document.root(), is_equality ? "equality" : "actuator");
    const auto number = static_cast<std::size_t>(part.id);
    if (number < all.size()) return all[number];
    return is_equality ? element_of({mjOBJ_BODY, body_of(part)}) : nullptr;  // a loop of the YAML
  }
  // MuJoCo numbers bodies in the order of the file, a parent before its children.
  const int body = body_of(part);
  tinyxml2::XMLElement* found = nullptr;
  int count = 0;
  document.visit([&](tinyxml2::XMLElement& element) {
    if (std::string_view(element.Name()) == "body" && ++count == body) found = &element;
  });
  if (found == nullptr || attribute(*found, "name") != name_of(model_, mjOBJ_BODY, body)) {
    return nullptr;
  }
  if (part.type == mjOBJ_BODY) return found;
  // Elements of one type on one body have the order of the file, too.
  int number = 0;
  while (part.id > number && body_of({part.type, part.id - number - 1}) == body) ++number;
  for (tinyxml2::XMLElement* const child : children(*found)) {
    const bool is_one = std::string_view(child->Name()).ends_with(tag_of(part.type));
    if (is_one && number-- == 0) return child;
  }
  return found;
}

std::string RobotSource::place_of(Part part) const {
  const tinyxml2::XMLElement* const element = element_of(part);
  const MjcfDocument& document = robot_.document;
  return document.place_of(element == nullptr ? document.root() : *element);
}

}  // namespace touchdown::models
