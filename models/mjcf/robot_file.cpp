#include "models/mjcf/robot_file.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"

namespace touchdown::models {

namespace {

using tinyxml2::XMLElement;

constexpr int most_geoms = 5000;  // compiled in about a second

/// A top-level section that is not simulated: ignored, or refused with "expected none: …".
struct Section {
  std::string_view tag;
  std::string_view reason;  ///< empty: without a word
  bool is_refused = false;
};
constexpr std::array sections = {
    Section{"option",
            "time step, solver, flags and gravity are the scenario's; air is not simulated"},
    Section{"contact", "parts of the robot do not collide with each other"},
    Section{"keyframe", "the start is the scenario's"},
    Section{"sensor", "joints and the IMU are measured, nothing else"},
    Section{"visual", "ignored"},
    Section{"statistic", "ignored"},
    Section{"custom", "ignored"},
    Section{"size", ""},
    Section{"tendon", "tendons are not supported", true},
    Section{"extension", "plugins are not run", true}};

bool is_any_of(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// Removes a section that is not simulated.
void reduce(RobotFile& robot, XMLElement& section) {
  const auto found = std::ranges::find(sections, std::string_view(section.Name()), &Section::tag);
  if (found == sections.end()) return;
  if (found->is_refused) {
    const XMLElement* const first = section.FirstChildElement();
    robot.document.fail(first != nullptr ? *first : section,
                        fmt::format("{}{}: expected none: {}", found->tag,
                                    first != nullptr ? " " + title_of(*first) : "", found->reason));
  }
  if (!found->reason.empty()) {
    robot.ignore(section, fmt::format("{}: {}", found->tag, found->reason));
  }
  robot.document.remove(section);
}

/// Keeps the connections that close legs.
void reduce_equality(RobotFile& robot, XMLElement& equality) {
  const std::string title = fmt::format("equality {}", title_of(equality));
  const std::string_view tag = equality.Name();
  if (attribute(equality, "active") == "false") {
    robot.ignore(equality, title + ": inactive");
    robot.document.remove(equality);
  } else if (tag != "connect") {
    robot.document.fail(equality, fmt::format("{}: expected none: {}", title,
                                              tag == "weld" ? "a <connect> closes a leg"
                                                            : "coupled joints are not supported"));
  }
}

/// Refuses actuators with a state of their own. (MuJoCo's complaint would be about their order.)
void check_actuator(const MjcfDocument& document, const XMLElement& actuator) {
  const std::string_view dynamics = attribute(actuator, "dyntype");
  if (is_any_of(actuator.Name(), {"intvelocity", "damper", "cylinder", "muscle", "adhesion"})) {
    document.fail(actuator, fmt::format("{}: expected a motor", title_of(actuator)));
  }
  if (dynamics.empty() || dynamics == "none") return;
  document.fail(
      actuator,
      fmt::format("{}: expected a motor, found an activation (dyntype; a lag of the torque is "
                  "'actuators: {{hip: {{torque_lag: …}}}}' in the YAML file)",
                  title_of(actuator)));
}

bool has_free_joint(const XMLElement& body) {
  return std::ranges::any_of(children(body), [](const XMLElement* e) {
    return std::string_view(e->Name()) == "freejoint" || attribute(*e, "type") == "free";
  });
}

/// Whether a body has a joint, or one below it has.
bool moves(XMLElement& body) {
  bool found = false;
  for_each_element(body, [&](const XMLElement& e) {
    found = found || is_any_of(e.Name(), {"joint", "freejoint", "composite", "flexcomp"});
  });
  return found;
}

/// Removes an element of the world unless it is the robot.
void reduce_world(RobotFile& robot, XMLElement& element, bool has_robot) {
  const std::string_view tag = element.Name();
  if (is_any_of(tag, {"light", "camera", "site"})) {
    robot.ignore(element, fmt::format("{} of the world: ignored", tag));
  } else if (tag == "geom" || (tag == "body" && !moves(element))) {
    robot.ignore(element,
                 title_of(element) + " of the world: the ground is the scenario's terrain");
  } else {
    if (tag != "body" || !has_robot || has_free_joint(element)) return;
    robot.document.fail(element,
                        fmt::format("{}: expected the robot alone, the body with the <freejoint/>",
                                    title_of(element)));
  }
  robot.document.remove(element);
}

/// Lets a robot float that is fixed to the world in its file, or moves on joints to it.
void let_float(RobotFile& robot) {
  const std::vector<XMLElement*> bodies = in_sections(robot.document.root(), "worldbody", "body");
  if (bodies.empty()) return;
  if (bodies.size() == 1) {
    const std::vector<XMLElement*> joints = children(*bodies[0], "joint");
    for (XMLElement* const joint : joints) robot.document.remove(*joint);
    robot.document.insert_last(*bodies[0], "<freejoint/>");
    robot.ignore(*bodies[0],
                 fmt::format("{}: {} to the world: it floats here", title_of(*bodies[0]),
                             joints.empty() ? "fixed" : "on joints"));
    return;
  }
  std::vector<std::string> titles;
  for (const XMLElement* const body : bodies) titles.push_back(title_of(*body));
  robot.document.fail(
      *bodies[0],
      fmt::format("{}: expected one body with a <freejoint/>: the world is their base; put what "
                  "moves into <body name=\"base\"><freejoint/><inertial …/> … </body>",
                  fmt::join(titles, ", ")));
}

/// Refuses what takes too long to compile, and bodies that make joints.
void check_elements(const MjcfDocument& document) {
  int geoms = 0;
  document.visit([&](const XMLElement& element) {
    const std::string_view tag = element.Name();
    if (tag == "geom" && ++geoms > most_geoms) {
      document.fail(element, fmt::format("geom: expected at most {} geoms", most_geoms));
    }
    if (tag == "composite") {
      document.fail(element, "composite: expected none: its joints would be no servos");
    }
  });
}

void require_mjcf(const MjcfDocument& document) {
  const XMLElement& root = document.root();
  const std::string_view tag = root.Name();
  if (tag == "mujoco" && root.FirstChildElement() != nullptr) return;
  document.fail(root, fmt::format("{}: expected a robot in <mujoco>...</mujoco>, or the <robot> of "
                                  "a URDF{}",
                                  tag, tag == "sdf" ? ": SDF is not read, convert it first" : ""));
}

}  // namespace

std::string missing(const MjcfDocument& document, const char* tag, const std::string& name) {
  std::vector<std::string> names;
  document.visit([&](const XMLElement& element) {
    if (std::string_view(element.Name()) == tag) names.emplace_back(attribute(element, "name"));
  });
  return fmt::format("expected a {} named '{}' in {}{}", tag, name,
                     document.file().filename().string(), found_text(name, names));
}

void keep_robot_only(RobotFile& robot) {
  MjcfDocument& document = robot.document;
  require_mjcf(document);
  XMLElement& root = document.root();
  const bool has_robot =
      std::ranges::any_of(in_sections(root, "worldbody", "body"),
                          [](const XMLElement* body) { return has_free_joint(*body); });
  for (XMLElement* const section : children(root)) reduce(robot, *section);
  for (XMLElement* const e : in_sections(root, "equality")) reduce_equality(robot, *e);
  for (XMLElement* const e : in_sections(root, "worldbody")) reduce_world(robot, *e, has_robot);
  for (XMLElement* const e : in_sections(root, "actuator")) check_actuator(document, *e);
  check_elements(document);
  if (!has_robot) let_float(robot);
  // Ranges count as limits without `limited`, as in MuJoCo from version 2.3 on. The file's own
  // <compiler> comes later and counts more.
  document.insert_first(root, "<compiler autolimits=\"true\"/>");
}

void note_computed_masses(RobotFile& robot) {
  const MjcfDocument& document = robot.document;
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
  robot.warnings.push_back(
      fmt::format("{}: mass of {} link{} computed from colliders, as if of water: {} (expected "
                  "<inertial>, or a mass or density of the shapes)",
                  document.place_of(*first), names.size(), names.size() == 1 ? "" : "s",
                  fmt::join(names, ", ")));
}

}  // namespace touchdown::models
