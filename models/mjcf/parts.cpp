#include "models/mjcf/parts.hpp"

#include <algorithm>
#include <initializer_list>
#include <map>

#include <Eigen/Core>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/yaml.hpp"
#include "models/mjcf/document.hpp"

namespace touchdown::models {

namespace {

bool is_number(std::string_view part) {
  return part.find_first_not_of("0123456789") == std::string_view::npos;
}

using tinyxml2::XMLElement;

constexpr std::string_view held_prefix = "touchdown_held_";
constexpr std::array<const char*, wheel_count> tyre_geoms = {"left_tire", "right_tire"};

}  // namespace

std::vector<std::string> names_of(const MjcfDocument& document,
                                  std::initializer_list<std::string_view> tags) {
  std::vector<std::string> names;
  document.visit([&](const XMLElement& element) {
    const std::string_view name = attribute(element, "name");
    if (std::find(tags.begin(), tags.end(), element.Name()) == tags.end() || name.empty()) return;
    names.emplace_back(name);
  });
  return names;
}

std::string missing(const MjcfDocument& document, std::initializer_list<std::string_view> tags,
                    const std::string& name) {
  return fmt::format("expected a {} named '{}' in {}{}", fmt::join(tags, " or a "), name,
                     document.file().filename().string(),
                     found_text(name, names_of(document, tags)));
}

XMLElement& named(const MjcfDocument& document, std::initializer_list<std::string_view> tags,
                  const std::string& name, std::string_view key, const RobotKeys& keys) {
  for (const std::string_view tag : tags) {
    if (XMLElement* const element = document.find(tag, name)) return *element;
  }
  keys.fail(key, missing(document, tags, name));
}

XMLElement& add_motor(MjcfDocument& document, const XMLElement& joint) {
  return document.add_to_section("actuator", "motor", joint);
}

XMLElement* only_motor_of(MjcfDocument& document, const std::string& joint) {
  std::vector<XMLElement*> motors = in_sections(document.root(), "actuator");
  std::erase_if(motors, [&](const XMLElement* motor) {
    return attribute(*motor, "joint") != joint && attribute(*motor, "jointinparent") != joint;
  });
  if (motors.size() > 1) {
    document.fail(*motors[1], fmt::format("{}: expected one motor for joint '{}', found several",
                                          title_of(*motors[1]), joint));
  }
  return motors.empty() ? nullptr : motors.front();
}

namespace {

bool is_body(const XMLElement& element) { return std::string_view(element.Name()) == "body"; }

/// Names a joint and its motor, if there is one.
void rename(XMLElement& joint, XMLElement* motor, const std::string& name) {
  joint.SetAttribute("name", name.c_str());
  if (motor == nullptr) return;
  motor->SetAttribute("name", name.c_str());
  motor->SetAttribute("joint", name.c_str());
  motor->DeleteAttribute("jointinparent");  // the same for hinges
}

/// The joint with a name that the YAML file gives under `key`.
XMLElement& named_joint(const MjcfDocument& document, const FileFindings& findings,
                        const std::string& name, const std::string& key, const RobotKeys& keys) {
  const bool is_fixed = std::ranges::count(findings.fixed, name) > 0;
  if (is_fixed) keys.fail(key, fmt::format("joint '{}' is fixed, expected a hinge", name));
  return named(document, {"joint"}, name, key, keys);
}

/// Refuses a joint with two names, which would be renamed twice.
void require_once(const PartNames& parts, const RobotKeys& keys) {
  std::map<std::string, std::string> key_of;
  const auto add = [&](const std::string& joint, const std::string& key) {
    const auto [other, is_new] = key_of.emplace(joint, key);
    if (!is_new) keys.fail(key, fmt::format("'{}' is the joint of {}, too", joint, other->second));
  };
  for (std::size_t i = 0; i < servo_count; ++i) {
    if (i % 3 == 0 && parts.joint[i].empty() && !parts.has_hips) continue;
    add(own_name(parts, i), fmt::format("joints.{}", servo_names[i]));
  }
  for (std::size_t i = 0; i < parts.held.size(); ++i) add(parts.held[i], fmt::format("held.{}", i));
}

void name_held(MjcfDocument& document, const std::vector<std::string>& held, FileFindings& findings,
               const RobotKeys& keys) {
  for (std::size_t i = 0; i < held.size(); ++i) {
    collect(findings.complaints, [&] {
      XMLElement& joint = named_joint(document, findings, held[i], fmt::format("held.{}", i), keys);
      XMLElement* const motor = only_motor_of(document, held[i]);
      rename(joint, motor != nullptr ? motor : &add_motor(document, joint), held_name(i));
    });
  }
}

/// Refuses a joint that has the name of a servo, but is none: its name would be taken.
void require_free_name(const MjcfDocument& document, const PartNames& parts, std::size_t servo) {
  const std::string name(servo_names[servo]);
  const XMLElement* const joint = document.find("joint", name);
  if (joint == nullptr ||
      std::find(parts.joint.begin(), parts.joint.end(), name) != parts.joint.end()) {
    return;
  }
  document.fail(*joint, fmt::format("joint '{}': expected it under `joints` or `held`, as '{}' is "
                                    "the {}",
                                    name, parts.joint[servo], name));
}

void name_servos(MjcfDocument& document, const PartNames& parts, FileFindings& findings,
                 const RobotKeys& keys) {
  // Found first and named afterwards, so that names can be exchanged.
  std::array<XMLElement*, servo_count> joints = {};
  std::array<XMLElement*, servo_count> motors = {};
  for (std::size_t i = 0; i < servo_count; ++i) {
    const std::string& own = parts.joint[i];
    if (i % 3 == 0 && own.empty() && !parts.has_hips) continue;
    collect(findings.complaints, [&] {
      motors[i] = only_motor_of(document, own_name(parts, i));
      if (own.empty()) {
        // The compiled model has the complaint about a joint that is missing.
        joints[i] = document.find("joint", servo_names[i]);
      } else {
        joints[i] =
            &named_joint(document, findings, own, fmt::format("joints.{}", servo_names[i]), keys);
        require_free_name(document, parts, i);
      }
    });
  }
  // The motors of a closed leg may be elsewhere.
  const bool has_loops = document.root().FirstChildElement("equality") != nullptr;
  for (std::size_t i = 0; i < servo_count; ++i) {
    if (joints[i] == nullptr) continue;
    if (motors[i] == nullptr && (i % 3 == 2 || !has_loops)) {
      motors[i] = &add_motor(document, *joints[i]);
    }
    rename(*joints[i], motors[i], std::string(servo_names[i]));
  }
}

/// Whether a geom is a round collider.
bool is_round_collider(const MjcfDocument& document, const XMLElement& geom) {
  const std::string_view type = attribute_or_default(document, geom, "type");
  const bool is_sphere = type == "sphere" || (type.empty() && geom.Attribute("mesh") == nullptr);
  return !is_visual(document, geom) && (is_sphere || type == "cylinder" || type == "capsule");
}

/// The round colliders of a body and of the bodies that are fixed to it.
void add_round_colliders(const MjcfDocument& document, XMLElement& body,
                         std::vector<XMLElement*>& found) {
  for (auto* e : children(body)) {
    const std::string_view tag = e->Name();
    if (tag == "geom" && is_round_collider(document, *e)) found.push_back(e);
    if (tag == "body" && e->FirstChildElement("joint") == nullptr) {
      add_round_colliders(document, *e, found);
    }
  }
}

double radius_of(const MjcfDocument& document, const XMLElement& geom) {
  const std::vector<double> size = numbers(attribute_or_default(document, geom, "size"));
  return size.empty() ? 0.0 : size.front();
}

/// The tyre of a wheel: its largest round collider.
XMLElement& largest_round_collider(const MjcfDocument& document, XMLElement& body,
                                   const std::string& key) {
  std::vector<XMLElement*> found;
  add_round_colliders(document, body, found);
  if (found.empty()) {
    document.fail(body,
                  fmt::format("{}: {}: expected a sphere, cylinder or capsule as its collider (for "
                              "a wheel that is a mesh, 'tyres: {{radius: …}}' in the YAML file)",
                              key, title_of(body)));
  }
  const auto is_smaller = [&](const XMLElement* a, const XMLElement* b) {
    return radius_of(document, *a) < radius_of(document, *b);
  };
  XMLElement* const largest = *std::max_element(found.begin(), found.end(), is_smaller);
  const auto count = std::count_if(found.begin(), found.end(), [&](const XMLElement* geom) {
    return !is_smaller(geom, largest);
  });
  if (count > 1) {
    document.fail(body,
                  fmt::format("{}: {}: expected one round collider, found several of the same "
                              "radius: name the tyre's geom",
                              key, title_of(body)));
  }
  return *largest;
}

/// The body that a wheel's joint moves; null if there is no such joint.
XMLElement* wheel_body(const MjcfDocument& document, std::size_t wheel) {
  XMLElement* const joint = document.find("joint", servo_names[index(wheel_servos[wheel])]);
  return joint == nullptr ? nullptr : joint->Parent()->ToElement();
}

Eigen::Vector3d vector_of(std::string_view text, const Eigen::Vector3d& otherwise) {
  const std::vector<double> x = numbers(text);
  return x.size() == 3 ? Eigen::Vector3d(x[0], x[1], x[2]) : otherwise;
}

/// Adds a sphere about a wheel's axle, abreast of its centre of mass, as the tyre of a wheel that
/// has no round collider.
XMLElement& sphere_about_axle(MjcfDocument& document, XMLElement& body, double radius) {
  using Eigen::Vector3d;
  const XMLElement& joint = *body.FirstChildElement("joint");
  const XMLElement* const inertial = body.FirstChildElement("inertial");
  const Vector3d anchor = vector_of(attribute_or_default(document, joint, "pos"), Vector3d::Zero());
  const Vector3d axis =
      vector_of(attribute_or_default(document, joint, "axis"), Vector3d::UnitZ()).normalized();
  const Vector3d mass =
      inertial == nullptr ? anchor : vector_of(attribute(*inertial, "pos"), anchor);
  const Vector3d middle = anchor + axis * axis.dot(mass - anchor);
  const bool has_shape = body.FirstChildElement("geom") != nullptr;
  document.insert_before(
      *body.FirstChildElement(),
      fmt::format("<geom type=\"sphere\" size=\"{}\" pos=\"{} {} {}\" quat=\"1 0 0 0\" mass=\"0\" "
                  "group=\"{}\" contype=\"1\" conaffinity=\"1\"/>",
                  radius, middle.x(), middle.y(), middle.z(), has_shape ? 3 : 0));
  return *body.FirstChildElement("geom");
}

void leave_untouched(XMLElement& geom) {
  geom.SetAttribute("contype", "0");
  geom.SetAttribute("conaffinity", "0");
}

/// The geom of a tyre that has another name than the contract's; null otherwise.
XMLElement* tyre_of(MjcfDocument& document, const PartNames& parts, std::size_t wheel,
                    const RobotKeys& keys) {
  const std::string& own = parts.tyre[wheel];
  const std::string key = fmt::format("tyres.{}", wheel == 0 ? "left" : "right");
  XMLElement* const moved = wheel_body(document, wheel);
  if (parts.tyre_radius > 0.0) {
    if (moved == nullptr) return nullptr;
    for_each_element(*moved, [](XMLElement& e) {
      if (std::string_view(e.Name()) == "geom") leave_untouched(e);
    });
    return &sphere_about_axle(document, *moved, parts.tyre_radius);
  }
  if (!own.empty()) {
    XMLElement& part = named(document, {"geom", "body"}, own, key, keys);
    return is_body(part) ? &largest_round_collider(document, part, key) : &part;
  }
  if (moved == nullptr || document.find("geom", tyre_geoms[wheel]) != nullptr) return nullptr;
  return &largest_round_collider(document, *moved, key);
}

void name_tyres(MjcfDocument& document, const PartNames& parts, FileFindings& findings,
                const RobotKeys& keys) {
  std::array<XMLElement*, wheel_count> tyres = {};
  for (std::size_t i = 0; i < wheel_count; ++i) {
    collect(findings.complaints, [&] { tyres[i] = tyre_of(document, parts, i, keys); });
  }
  for (std::size_t i = 0; i < wheel_count; ++i) {
    if (tyres[i] == nullptr) continue;
    // A name may be that of another geom.
    XMLElement* const usual = document.find("geom", tyre_geoms[i]);
    if (usual != nullptr && usual != tyres[1 - i]) usual->DeleteAttribute("name");
    tyres[i]->SetAttribute("name", tyre_geoms[i]);
  }
}

void name_imu(MjcfDocument& document, const std::string& given, const RobotKeys& keys) {
  const std::string own = given.empty() ? "imu" : given;
  XMLElement* const usual = own == "imu" ? nullptr : document.find("site", "imu");
  if (usual != nullptr) usual->DeleteAttribute("name");
  const bool has_own =
      document.find("site", own) != nullptr || document.find("body", own) != nullptr;
  if (given.empty() && !has_own) return;
  XMLElement& part = named(document, {"site", "body"}, own, "imu", keys);
  (is_body(part) ? document.add(part, "site", part) : part).SetAttribute("name", "imu");
}

/// Lets the named geoms, and all geoms of the named bodies, touch nothing.
void leave_untouched(MjcfDocument& document, const std::vector<std::string>& names,
                     FileFindings& findings, const RobotKeys& keys) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    collect(findings.complaints, [&] {
      XMLElement& part =
          named(document, {"geom", "body"}, names[i], fmt::format("no_collision.{}", i), keys);
      if (!is_body(part)) return leave_untouched(part);
      for (auto* geom : children(part, "geom")) leave_untouched(*geom);
    });
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

void RobotKeys::fail(std::string_view key, const std::string& message) const {
  const YamlDocument document = YamlDocument::load(file_);
  YAML::Node node = document.root();
  std::string shown;
  for (std::string_view rest = key; !rest.empty();) {
    const std::string part(rest.substr(0, rest.find('.')));
    rest.remove_prefix(std::min(rest.size(), part.size() + 1));
    const YAML::Node inner = is_number(part) ? node[std::stoul(part)] : node[part];
    if (!inner.IsDefined()) break;
    node.reset(inner);
    if (!is_number(part)) shown += (shown.empty() ? "" : ".") + part;
  }
  throw InputError(fmt::format("{}: {}: {}", document.place_of(node, key),
                               shown.empty() ? key : shown, message));
}

void name_parts(MjcfDocument& document, const PartNames& parts, FileFindings& findings,
                const RobotKeys& keys) {
  require_once(parts, keys);
  leave_untouched(document, parts.no_collision, findings, keys);
  name_held(document, parts.held, findings, keys);
  name_servos(document, parts, findings, keys);
  name_tyres(document, parts, findings, keys);
  collect(findings.complaints, [&] { name_imu(document, parts.imu, keys); });
}

std::string held_name(std::size_t number) { return fmt::format("{}{}", held_prefix, number); }

bool is_held_name(const char* name) {
  return name != nullptr && std::string_view(name).starts_with(held_prefix);
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
