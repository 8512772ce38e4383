#include "models/mjcf/robot_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "models/mjcf/document.hpp"

namespace touchdown::models {

namespace {

using tinyxml2::XMLElement;

constexpr int most_geoms = 5000;  // compiled in about a second

bool is_any_of(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// Whether all numbers of an attribute are about those of `expected`.
bool is_about(std::string_view text, const std::vector<double>& expected) {
  constexpr double close = 0.02;  // 9.8 and 9.80665 m/s² are 9.81
  const std::vector<double> found = numbers(text);
  return std::equal(found.begin(), found.end(), expected.begin(), expected.end(),
                    [](double a, double b) { return std::abs(a - b) <= close; });
}

bool is_zero(std::string_view text) {
  const std::vector<double> found = numbers(text);
  return std::all_of(found.begin(), found.end(), [](double x) { return x == 0.0; });
}

/// Refuses options that change the physics of one engine.
void check_option(const MjcfDocument& document, const XMLElement& option) {
  for (const auto* a = option.FirstAttribute(); a != nullptr; a = a->Next()) {
    const std::string_view name = a->Name();
    if (name == "gravity" && !is_about(a->Value(), {0.0, 0.0, -9.81})) {
      document.fail(option,
                    fmt::format("option: gravity \"{}\": expected \"0 0 -9.81\"", a->Value()));
    }
    if (is_any_of(name, {"density", "viscosity", "wind"}) && !is_zero(a->Value())) {
      document.fail(option, fmt::format("option: {} \"{}\": expected none: air is not simulated",
                                        name, a->Value()));
    }
  }
  for (auto* flag : children(option, "flag")) {
    for (const auto* a = flag->FirstAttribute(); a != nullptr; a = a->Next()) {
      const bool is_physics =
          is_any_of(a->Name(), {"constraint", "frictionloss", "limit", "contact", "passive",
                                "gravity", "clampctrl", "actuation", "spring", "damper"});
      if (is_physics && std::string_view(a->Value()) != "enable") {
        document.fail(*flag,
                      fmt::format("flag: {} \"{}\": expected \"enable\"", a->Name(), a->Value()));
      }
    }
  }
}

void check_equality(const MjcfDocument& document, const XMLElement& section) {
  for (auto* e : children(section)) {
    if (attribute(*e, "active") == "false") continue;
    const bool closes = is_any_of(e->Name(), {"connect", "weld"});
    document.fail(*e, fmt::format("equality {}: expected none: {}", title_of(*e),
                                  closes ? "closed chains, such as five-bar legs, are not supported"
                                         : "coupled joints are not supported"));
  }
}

/// Checks a top-level section. Returns the note on it if it is removed.
std::string removed_section(const MjcfDocument& document, XMLElement& section) {
  const std::string_view tag = section.Name();
  if (tag == "option") {
    check_option(document, section);
    return "option: time step, solver and flags are the scenario's";
  }
  if (tag == "equality") {
    check_equality(document, section);
    return "equality: inactive";
  }
  if (tag == "tendon") {
    const XMLElement* first = section.FirstChildElement();
    document.fail(first != nullptr ? *first : section,
                  fmt::format("tendon{}: expected none: tendons are not supported",
                              first != nullptr ? " " + title_of(*first) : ""));
  }
  if (tag == "extension") document.fail(section, "extension: expected none: plugins are not run");
  if (tag == "contact") return "contact: parts of the robot do not collide with each other";
  if (tag == "keyframe") return "keyframe: the start is the scenario's";
  if (tag == "sensor") return "sensor: joints and the IMU are measured, nothing else";
  if (is_any_of(tag, {"visual", "statistic", "custom"})) return fmt::format("{}: ignored", tag);
  return {};
}

/// Refuses actuators with a state of their own. (MuJoCo's complaint would be about their order.)
void check_actuators(const MjcfDocument& document, const XMLElement& section) {
  for (auto* e : children(section)) {
    const std::string_view dynamics = attribute(*e, "dyntype");
    if (!dynamics.empty() && dynamics != "none") {
      document.fail(
          *e, fmt::format("{}: expected a motor, found an activation (dyntype)", title_of(*e)));
    }
    if (is_any_of(e->Name(), {"intvelocity", "damper", "cylinder", "muscle", "adhesion"})) {
      document.fail(*e, fmt::format("{}: expected a motor", title_of(*e)));
    }
  }
}

bool has_free_joint(const XMLElement& body) {
  for (auto* e : children(body)) {
    if (std::string_view(e->Name()) == "freejoint") return true;
    if (std::string_view(e->Name()) == "joint" && attribute(*e, "type") == "free") return true;
  }
  return false;
}

/// Whether a body holds nothing that moves or touches: a frame, a camera, a light.
bool is_empty(const XMLElement& body) {
  for (auto* e : children(body)) {
    const std::string_view tag = e->Name();
    if (is_any_of(tag, {"geom", "joint", "freejoint", "composite", "flexcomp"})) return false;
    if (tag == "body" && !is_empty(*e)) return false;
  }
  return true;
}

/// Checks an element of the world. Returns the note on it if it is removed.
std::string removed_from_world(const MjcfDocument& document, XMLElement& element, bool has_robot) {
  const std::string_view tag = element.Name();
  if (tag == "geom") {
    if (attribute(element, "type") == "plane") return "floor: the ground is the scenario's terrain";
    document.fail(element, fmt::format("{} of the world: expected the robot alone: the ground is "
                                       "the scenario's terrain",
                                       title_of(element)));
  }
  if (is_any_of(tag, {"light", "camera", "site"})) {
    return fmt::format("{} of the world: ignored", tag);
  }
  if (tag != "body") return {};
  if (attribute(element, "mocap") == "true") {
    document.fail(element, fmt::format("{}: expected no mocap body", title_of(element)));
  }
  if (!has_robot || has_free_joint(element)) return {};
  if (is_empty(element)) return "body without geoms: ignored";
  document.fail(element, fmt::format("{}: expected the robot alone, the body with the <freejoint/>",
                                     title_of(element)));
}

void note(std::vector<std::string>& notes, const MjcfDocument& document, const XMLElement& element,
          const std::string& text) {
  notes.push_back(document.place_of(element) + ": " + text);
}

void reduce_world(MjcfDocument& document, XMLElement& world, bool has_robot,
                  std::vector<std::string>& notes) {
  for (XMLElement* const e : children(world)) {
    const std::string removed = removed_from_world(document, *e, has_robot);
    if (removed.empty()) continue;
    note(notes, document, *e, removed);
    document.remove(*e);
  }
  int geoms = 0;
  for_each_element(world, [&](XMLElement& e) {
    const std::string_view tag = e.Name();
    if (tag == "geom" && ++geoms > most_geoms) {
      document.fail(e, fmt::format("geom: expected at most {} geoms", most_geoms));
    }
    if (tag == "geom" && attribute(e, "type") == "hfield") {
      document.fail(
          e, fmt::format("{}: expected no height field: Bullet has no counterpart", title_of(e)));
    }
    if (tag == "composite") {
      document.fail(e, "composite: expected none: its joints would be no servos");
    }
  });
}

/// Of the sizes, those of user data belong to the robot's elements.
void reduce_sizes(XMLElement& size) {
  for (const auto* a = size.FirstAttribute(); a != nullptr;) {
    const auto* const next = a->Next();
    if (!std::string_view(a->Name()).starts_with("nuser")) size.DeleteAttribute(a->Name());
    a = next;
  }
}

/// Ranges count as limits without `limited`, as in MuJoCo from version 2.3 on.
void limit_by_ranges(MjcfDocument& document) {
  XMLElement* compiler = nullptr;
  for (auto* e : children(document.root(), "compiler")) {
    if (e->Attribute("autolimits") != nullptr) return;
    if (compiler == nullptr) compiler = e;
  }
  if (compiler != nullptr) {
    compiler->SetAttribute("autolimits", "true");
  } else if (XMLElement* const first = document.root().FirstChildElement()) {
    document.insert_before(*first, "<compiler autolimits=\"true\"/>");
  }
}

}  // namespace

std::vector<std::string> keep_robot_only(MjcfDocument& document) {
  std::vector<std::string> notes;
  limit_by_ranges(document);
  XMLElement& root = document.root();
  bool has_robot = false;
  for (auto* world : children(root, "worldbody")) {
    for (auto* body : children(*world, "body")) {
      has_robot = has_robot || has_free_joint(*body);
    }
  }
  for (XMLElement* const section : children(root)) {
    const std::string removed = removed_section(document, *section);
    const std::string_view tag = section->Name();
    if (!removed.empty()) {
      note(notes, document, *section, removed);
      document.remove(*section);
    } else if (tag == "worldbody") {
      reduce_world(document, *section, has_robot, notes);
    } else if (tag == "actuator") {
      check_actuators(document, *section);
    } else if (tag == "size") {
      reduce_sizes(*section);
    }
  }
  return notes;
}

}  // namespace touchdown::models
