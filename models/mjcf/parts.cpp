#include "models/mjcf/parts.hpp"

#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "core/error.hpp"

namespace touchdown::models {

namespace {

using tinyxml2::XMLElement;

constexpr std::array<const char*, wheel_count> tyre_geoms = {"left_tire", "right_tire"};

[[noreturn]] void fail_in(const MjcfDocument& document, const std::string& message) {
  throw InputError(document.file().string() + ": " + message);
}

XMLElement& expect(const MjcfDocument& document, const char* tag, const std::string& name,
                   const std::string& key) {
  if (XMLElement* const found = document.find(tag, name)) return *found;
  fail_in(document, fmt::format("{}: expected a {} named '{}'", key, tag, name));
}

/// The element that holds the actuators, if any.
XMLElement* actuators_of(MjcfDocument& document) {
  return document.root().FirstChildElement("actuator");
}

std::vector<XMLElement*> motors_of(MjcfDocument& document, std::string_view joint) {
  std::vector<XMLElement*> motors;
  for (auto* section = actuators_of(document); section != nullptr;
       section = section->NextSiblingElement("actuator")) {
    for (auto* motor = section->FirstChildElement(); motor != nullptr;
         motor = motor->NextSiblingElement()) {
      if (attribute(*motor, "joint") == joint) motors.push_back(motor);
    }
  }
  return motors;
}

void remove_held(MjcfDocument& document, const std::vector<std::string>& held) {
  for (const std::string& name : held) {
    XMLElement& joint = expect(document, "joint", name, "held");
    for (XMLElement* const motor : motors_of(document, name)) {
      motor->Parent()->DeleteChild(motor);
    }
    joint.Parent()->DeleteChild(&joint);
  }
}

/// The torque limit of a servo that has no motor in the file.
double limit_without_motor(const MjcfDocument& document, const RobotDescription& description,
                           const std::map<std::string, double>& effort, std::size_t servo) {
  const std::string& joint = description.parts.joint[servo];
  if (const auto found = effort.find(joint); found != effort.end()) return found->second;
  const auto& actuator = description.actuator(static_cast<Servo>(servo));
  if (actuator && std::isfinite(actuator->maximum_torque)) return actuator->maximum_torque;
  fail_in(
      document,
      fmt::format("joint '{}': expected a motor that drives it, an effort limit in the URDF, or "
                  "'actuators: {{{}: {{maximum_torque: …}}}}' in the YAML file",
                  joint, std::array{"hip", "knee", "wheel"}[servo % 3]));
}

void add_motor(MjcfDocument& document, const std::string& joint, double limit) {
  if (actuators_of(document) == nullptr) {
    document.root().InsertEndChild(document.root().GetDocument()->NewElement("actuator"));
  }
  XMLElement* const motor = document.root().GetDocument()->NewElement("motor");
  motor->SetAttribute("name", joint.c_str());
  motor->SetAttribute("joint", joint.c_str());
  motor->SetAttribute("ctrlrange", fmt::format("{} {}", -limit, limit).c_str());
  actuators_of(document)->InsertEndChild(motor);
}

void name_servos(MjcfDocument& document, const RobotDescription& description,
                 const std::map<std::string, double>& effort) {
  // Found first and named afterwards, so that names can be exchanged.
  std::array<XMLElement*, servo_count> joints = {};
  std::array<std::vector<XMLElement*>, servo_count> motors;
  for (std::size_t i = 0; i < servo_count; ++i) {
    const std::string& own = description.parts.joint[i];
    if (own.empty()) continue;
    joints[i] = &expect(document, "joint", own, fmt::format("joints.{}", servo_names[i]));
    motors[i] = motors_of(document, own);
    if (motors[i].size() > 1) {
      document.fail(*motors[i][1],
                    fmt::format("{}: expected one motor for joint '{}', found several",
                                title_of(*motors[i][1]), own));
    }
  }
  for (std::size_t i = 0; i < servo_count; ++i) {
    if (joints[i] == nullptr) continue;
    const std::string name(servo_names[i]);
    joints[i]->SetAttribute("name", name.c_str());
    for (XMLElement* const motor : motors[i]) {
      motor->SetAttribute("name", name.c_str());
      motor->SetAttribute("joint", name.c_str());
    }
    if (motors[i].empty()) {
      add_motor(document, name, limit_without_motor(document, description, effort, i));
    }
  }
}

/// Whether a geom is a round collider, as far as its own attributes show.
bool is_round_collider(const XMLElement& geom) {
  const std::string_view type = attribute(geom, "type");
  const bool is_visual = attribute(geom, "contype") == "0" && attribute(geom, "conaffinity") == "0";
  const bool is_sphere = type == "sphere" || (type.empty() && geom.Attribute("mesh") == nullptr);
  return !is_visual && (is_sphere || type == "cylinder" || type == "capsule");
}

XMLElement& only_round_collider(const MjcfDocument& document, XMLElement& body,
                                const std::string& key) {
  XMLElement* found = nullptr;
  for (auto* geom = body.FirstChildElement("geom"); geom != nullptr;
       geom = geom->NextSiblingElement("geom")) {
    if (!is_round_collider(*geom)) continue;
    if (found != nullptr) {
      document.fail(body,
                    fmt::format("{}: {}: expected one round collider, found several: name the "
                                "tyre's geom",
                                key, title_of(body)));
    }
    found = geom;
  }
  if (found == nullptr) {
    document.fail(body,
                  fmt::format("{}: {}: expected a sphere, cylinder or capsule as its collider", key,
                              title_of(body)));
  }
  return *found;
}

/// The geom of a tyre that has another name than the contract's; null otherwise.
XMLElement* tyre_of(MjcfDocument& document, const PartNames& parts, std::size_t wheel) {
  const std::string& own = parts.tyre[wheel];
  const std::string key = fmt::format("tyres.{}", wheel == 0 ? "left" : "right");
  if (!own.empty()) {
    if (XMLElement* const geom = document.find("geom", own)) return geom;
    if (XMLElement* const body = document.find("body", own)) {
      return &only_round_collider(document, *body, key);
    }
    fail_in(document, fmt::format("{}: expected a geom or a body named '{}'", key, own));
  }
  const std::size_t servo = index(wheel_servos[wheel]);
  if (parts.joint[servo].empty() || document.find("geom", tyre_geoms[wheel]) != nullptr) {
    return nullptr;
  }
  XMLElement* const joint = document.find("joint", servo_names[servo]);
  return &only_round_collider(document, *joint->Parent()->ToElement(), key);
}

void name_tyres(MjcfDocument& document, const PartNames& parts) {
  std::array<XMLElement*, wheel_count> tyres = {};
  for (std::size_t i = 0; i < wheel_count; ++i) tyres[i] = tyre_of(document, parts, i);
  for (std::size_t i = 0; i < wheel_count; ++i) {
    if (tyres[i] != nullptr) tyres[i]->SetAttribute("name", tyre_geoms[i]);
  }
}

void name_imu(MjcfDocument& document, const std::string& own) {
  if (own.empty()) return;
  XMLElement* const usual = own == "imu" ? nullptr : document.find("site", "imu");
  if (usual != nullptr) usual->DeleteAttribute("name");
  if (XMLElement* const site = document.find("site", own)) {
    site->SetAttribute("name", "imu");
  } else if (XMLElement* const body = document.find("body", own)) {
    XMLElement* const added = document.root().GetDocument()->NewElement("site");
    added->SetAttribute("name", "imu");
    body->InsertEndChild(added);
  } else {
    fail_in(document, fmt::format("imu: expected a site or a body named '{}'", own));
  }
}

/// The same part of the other leg; empty for any other name.
std::string mirrored_name(std::string_view name) {
  for (std::size_t i = 0; i < servo_count; ++i) {
    if (name == servo_names[i]) return std::string(servo_names[(i + 3) % servo_count]);
  }
  for (std::size_t i = 0; i < wheel_count; ++i) {
    if (name == tyre_geoms[i]) return tyre_geoms[1 - i];
  }
  return {};
}

}  // namespace

void name_parts(MjcfDocument& document, const RobotDescription& description,
                const std::map<std::string, double>& effort) {
  remove_held(document, description.parts.held);
  name_servos(document, description, effort);
  name_tyres(document, description.parts);
  name_imu(document, description.parts.imu);
}

void swap_sides(MjcfDocument& document) {
  for_each_element(document.root(), [](XMLElement& element) {
    const std::string_view tag = element.Name();
    if (tag == "joint" || tag == "geom") {
      const std::string other = mirrored_name(attribute(element, "name"));
      if (!other.empty()) element.SetAttribute("name", other.c_str());
      return;
    }
    const std::string other = mirrored_name(attribute(element, "joint"));
    if (other.empty()) return;
    element.SetAttribute("joint", other.c_str());
    element.SetAttribute("name", other.c_str());
  });
}

std::string own_name(const PartNames& parts, std::size_t servo) {
  return parts.joint[servo].empty() ? std::string(servo_names[servo]) : parts.joint[servo];
}

}  // namespace touchdown::models
