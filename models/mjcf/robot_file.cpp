#include "models/mjcf/robot_file.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "models/mjcf/document.hpp"

namespace touchdown::models {

namespace {

using tinyxml2::XMLElement;

constexpr int most_geoms = 5000;  // compiled in about a second

bool is_any_of(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// Writes a sentence about an element, with its place.
void note(std::vector<std::string>& notes, const MjcfDocument& document, const XMLElement& element,
          const std::string& text) {
  notes.push_back(document.place_of(element) + ": " + text);
}

/// Keeps the connections that close legs. Returns whether there are none.
bool has_no_loops(MjcfDocument& document, XMLElement& section, FileFindings& findings) {
  for (XMLElement* const e : children(section)) {
    const std::string_view tag = e->Name();
    if (attribute(*e, "active") == "false") {
      note(findings.ignored, document, *e, fmt::format("equality {}: inactive", title_of(*e)));
    } else if (tag != "connect") {
      note(findings.complaints, document, *e,
           fmt::format(
               "equality {}: expected none: {}", title_of(*e),
               tag == "weld" ? "a <connect> closes a leg" : "coupled joints are not supported"));
    } else {
      continue;
    }
    document.remove(*e);
  }
  return section.FirstChildElement() == nullptr;
}

/// Complains of a top-level section that not every engine simulates. Returns whether it is one.
bool is_refused(const MjcfDocument& document, const XMLElement& section,
                std::vector<std::string>& complaints) {
  const std::string_view tag = section.Name();
  const XMLElement* const first = section.FirstChildElement();
  if (tag == "tendon") {
    note(complaints, document, first != nullptr ? *first : section,
         fmt::format("tendon{}: expected none: tendons are not supported",
                     first != nullptr ? " " + title_of(*first) : ""));
  } else if (tag == "extension") {
    note(complaints, document, section, "extension: expected none: plugins are not run");
  } else {
    return false;
  }
  return true;
}

/// Why a top-level section does not count; empty if it does.
std::string_view reason_to_ignore(std::string_view tag) {
  if (tag == "option") {
    return "time step, solver, flags and gravity are the scenario's; air is not simulated";
  }
  if (tag == "contact") return "parts of the robot do not collide with each other";
  if (tag == "keyframe") return "the start is the scenario's";
  if (tag == "sensor") return "joints and the IMU are measured, nothing else";
  return is_any_of(tag, {"visual", "statistic", "custom"}) ? "ignored" : "";
}

/// Refuses actuators with a state of their own. (MuJoCo's complaint would be about their order.)
void check_actuators(const MjcfDocument& document, const XMLElement& section,
                     std::vector<std::string>& complaints) {
  for (auto* e : children(section)) {
    const std::string_view dynamics = attribute(*e, "dyntype");
    if (!dynamics.empty() && dynamics != "none") {
      note(complaints, document, *e,
           fmt::format("{}: expected a motor, found an activation (dyntype; a lag of the torque is "
                       "'actuators: {{hip: {{torque_lag: …}}}}' in the YAML file)",
                       title_of(*e)));
    }
    if (is_any_of(e->Name(), {"intvelocity", "damper", "cylinder", "muscle", "adhesion"})) {
      note(complaints, document, *e, fmt::format("{}: expected a motor", title_of(*e)));
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

/// Whether a body has a joint, or one below it has.
bool moves(XMLElement& body) {
  bool found = false;
  for_each_element(body, [&](const XMLElement& e) {
    found = found || is_any_of(e.Name(), {"joint", "freejoint", "composite", "flexcomp"});
  });
  return found;
}

/// Checks an element of the world. Returns the note on it if it is removed.
std::string removed_from_world(const MjcfDocument& document, XMLElement& element, bool has_robot,
                               std::vector<std::string>& complaints) {
  const std::string_view tag = element.Name();
  if (is_any_of(tag, {"light", "camera", "site"})) {
    return fmt::format("{} of the world: ignored", tag);
  }
  if (tag == "geom" || (tag == "body" && !moves(element))) {
    return title_of(element) + " of the world: the ground is the scenario's terrain";
  }
  if (tag == "body" && has_robot && !has_free_joint(element)) {
    note(complaints, document, element,
         fmt::format("{}: expected the robot alone, the body with the <freejoint/>",
                     title_of(element)));
  }
  return {};
}

/// Lets a robot float that is fixed to the world in its file.
void let_float(MjcfDocument& document, FileFindings& findings) {
  const std::vector<XMLElement*> bodies = in_sections(document.root(), "worldbody", "body");
  std::vector<std::string> titles;
  for (const XMLElement* const body : bodies) titles.push_back(title_of(*body));
  if (bodies.size() == 1) {
    document.add(*bodies[0], "freejoint", *bodies[0]);
    note(findings.ignored, document, *bodies[0],
         titles[0] + ": fixed to the world: it floats here");
  } else if (!bodies.empty()) {
    note(findings.complaints, document, *bodies[0],
         fmt::format("{}: expected one body with a <freejoint/>: the world is their base; put what "
                     "moves into <body name=\"base\"><freejoint/><inertial …/> … </body>",
                     fmt::join(titles, ", ")));
  }
}

void reduce_world(MjcfDocument& document, XMLElement& world, bool has_robot,
                  FileFindings& findings) {
  for (XMLElement* const e : children(world)) {
    const std::string removed = removed_from_world(document, *e, has_robot, findings.complaints);
    if (removed.empty()) continue;
    note(findings.ignored, document, *e, removed);
    document.remove(*e);
  }
  int geoms = 0;
  for_each_element(world, [&](XMLElement& e) {
    const std::string_view tag = e.Name();
    if (tag == "geom" && ++geoms > most_geoms) {
      document.fail(e, fmt::format("geom: expected at most {} geoms", most_geoms));
    }
    if (tag == "geom" && attribute(e, "type") == "hfield") {
      note(findings.complaints, document, e,
           fmt::format("{}: expected no height field: Bullet has no counterpart", title_of(e)));
    }
    if (tag == "composite") {
      note(findings.complaints, document, e,
           "composite: expected none: its joints would be no servos");
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

RobotRefusal::RobotRefusal(const std::vector<std::string>& all)
    : InputError(all.size() == 1 ? all[0]
                                 : fmt::format("{} (the first of {} reasons; `touchdown check` of "
                                               "this robot prints all)",
                                               all[0], all.size())),
      complaints(all) {}

void require_none(const std::vector<std::string>& complaints) {
  if (!complaints.empty()) throw RobotRefusal(complaints);
}

void note_computed_masses(const MjcfDocument& document, FileFindings& findings) {
  std::vector<std::string> names;
  const XMLElement* first = nullptr;
  document.visit([&](const XMLElement& body) {
    const bool is_body = std::string_view(body.Name()) == "body";
    if (!is_body || body.FirstChildElement("inertial") != nullptr) return;
    const bool is_computed =
        std::ranges::any_of(children(body, "geom"), [&](const XMLElement* geom) {
          return attribute_or_default(document, *geom, "mass").empty() &&
                 attribute_or_default(document, *geom, "density").empty();
        });
    if (!is_computed) return;
    if (names.empty()) first = &body;
    names.push_back(fmt::format("'{}'", attribute(body, "name")));
  });
  if (names.empty()) return;
  note(findings.warnings, document, *first,
       fmt::format("mass of {} link{} computed from colliders, as if of water: {} (expected "
                   "<inertial>, or a mass or density of the shapes)",
                   names.size(), names.size() == 1 ? "" : "s", fmt::join(names, ", ")));
}

void keep_robot_only(MjcfDocument& document, FileFindings& findings) {
  limit_by_ranges(document);
  XMLElement& root = document.root();
  const bool has_robot =
      std::ranges::any_of(in_sections(root, "worldbody", "body"),
                          [](const XMLElement* body) { return has_free_joint(*body); });
  for (XMLElement* const section : children(root)) {
    const std::string_view tag = section->Name();
    const std::string_view reason = reason_to_ignore(tag);
    if (is_refused(document, *section, findings.complaints) ||
        (tag == "equality" && has_no_loops(document, *section, findings))) {
      document.remove(*section);
    } else if (!reason.empty()) {
      note(findings.ignored, document, *section, fmt::format("{}: {}", tag, reason));
      document.remove(*section);
    } else if (tag == "worldbody") {
      reduce_world(document, *section, has_robot, findings);
    } else if (tag == "actuator") {
      check_actuators(document, *section, findings.complaints);
    } else if (tag == "size") {
      reduce_sizes(*section);
    }
  }
  if (!has_robot) let_float(document, findings);
}

}  // namespace touchdown::models
