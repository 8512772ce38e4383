#include <algorithm>
#include <iterator>

#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include "models/mjcf/robot_file.hpp"

namespace touchdown::models {

namespace {

using tinyxml2::XMLElement;

constexpr std::string_view flattened =
    "MuJoCo 3 writes a file without it: `python3 -c \"import mujoco as m; "
    "m.mj_saveLastXML('flat.xml', m.MjModel.from_xml_path('robot.xml'))\"`";
constexpr std::string_view rigid = "deformable bodies are not simulated";

/// What becomes of a word that later versions of MuJoCo added: an element or an attribute.
struct Word {
  std::string_view name;
  std::string_view tag = {};      ///< of the attribute's element; empty: of any
  std::string_view version = {};  ///< MuJoCo's, for a word that acts on the robot: it is refused
  std::string_view instead = {};  ///< what to write
  std::string_view renamed = {};  ///< an attribute of this version; empty: dropped
};
/// Versions are from MuJoCo's changelog (doc/changelog.rst of google-deepmind/mujoco), and from the
/// notes of its releases 3.11.0 and 3.12.0. The scene overrides what is dropped, such as a servo's
/// law, or it is only drawn.
constexpr Word later_words[] = {
    {"plugin", "", "2.3.0", "plugins are not run"},
    {"gravcomp", "body", "2.3.1", "the weight of all bodies counts"},
    {"deformable", "", "3.0.0", rigid},
    {"flexcomp", "", "3.0.0", rigid},
    {"frame", "", "3.1.0", flattened},
    {"replicate", "", "3.1.5", flattened},
    {"attach", "", "3.2.0", flattened},
    {"surfacevel", "geom", "3.11.0", "the ground is the scenario's terrain"},
    {"pid", "", "3.12.0", "expected a <motor> or <position> with a forcerange"},
    {.name = "kv", .tag = "position", .renamed = "user"},
    {.name = "actuatorfrcrange", .tag = "joint", .renamed = "user"},
    {.name = "actuatorforcerange", .tag = "joint", .renamed = "user"},
    {"actuatorfrclimited", "joint"},
    {"actuatorforcelimited", "joint"},
    {"actuatorgravcomp", "joint"},
    {"align", "freejoint"},
    {"dampratio", "position"},
    {"timeconst", "position"},
    {"inheritrange", "position"},
    {"actdim", "general"},
    {"actearly"},
    {"alignfree", "compiler"},
    {"saveinertial", "compiler"},
    {"assetdir", "compiler"},
    {"content_type"},
    {"colorspace", "texture"},
    {"nchannel", "texture"},
    {"inertia", "mesh"},
    {"maxhullvert", "mesh"},
    {"layer"},
    {"metallic", "material"},
    {"roughness", "material"},
    {"resolution", "camera"},
    {"sensorsize", "camera"},
    {"orthographic", "camera"},
    {"focal", "camera"},
    {"focalpixel", "camera"},
    {"principal", "camera"},
    {"principalpixel", "camera"},
    {"output", "camera"},
    {"bulbradius", "light"},
    {"intensity", "light"},
    {"range", "light"},
    {"type", "light"},
    {"texture", "light"}};

/// The word of an element, with an empty tag, or of an attribute; null for one of this version.
const Word* word_of(std::string_view name, std::string_view tag) {
  const auto* const found = std::ranges::find_if(later_words, [&](const Word& word) {
    return word.name == name && (word.tag.empty() || word.tag == tag);
  });
  return found == std::end(later_words) ? nullptr : found;
}

[[noreturn]] void refuse(const MjcfDocument& document, const XMLElement& element,
                         const Word& word) {
  document.fail(
      element, fmt::format("{}: `{}` came with MuJoCo {}; this is MuJoCo {}: {}", title_of(element),
                           word.name, word.version, mj_versionString(), word.instead));
}

void ignore(RobotFile& robot, const XMLElement& element, const Word& word) {
  robot.ignore(element, fmt::format("{}: {}: of a later MuJoCo, and without effect here",
                                    title_of(element), word.name));
}

void translate_attribute(RobotFile& robot, XMLElement& element, const std::string& name) {
  // The place of what is renamed is free: nothing reads user data.
  if (name == "user") return robot.document.replace(element, "user");
  const Word* const word = word_of(name, element.Name());
  const std::string value(attribute(element, name.c_str()));
  if (word == nullptr || value == "shell") return;  // MuJoCo refuses shells itself
  const bool is_zero = std::ranges::all_of(numbers(value), [](double x) { return x == 0.0; });
  if (!word->version.empty() && !is_zero) refuse(robot.document, element, *word);
  const bool is_off = attribute(element, "actuatorfrclimited") == "false" ||
                      attribute(element, "actuatorforcelimited") == "false";
  if (!word->renamed.empty() && !is_off) {
    return robot.document.replace(element, name.c_str(), std::string(word->renamed), value);
  }
  if (!name.starts_with("actuatorf")) ignore(robot, element, *word);
  robot.document.replace(element, name.c_str());
}

void translate(RobotFile& robot, XMLElement& element) {
  const std::vector<XMLElement*> inside = children(element);
  const Word* const word = word_of(element.Name(), "");
  if (word != nullptr && word->version.empty()) {
    ignore(robot, element, *word);
    return robot.document.remove(element);
  }
  if (word != nullptr) {
    const auto* const first = element.FirstAttribute();
    const bool has_pose =
        first != nullptr && (std::string_view(first->Name()) != "name" || first->Next() != nullptr);
    if (word->name != "frame" || has_pose) refuse(robot.document, element, *word);
    robot.document.unwrap(element);
  } else {
    std::vector<std::string> names;
    for (const auto* a = element.FirstAttribute(); a != nullptr; a = a->Next()) {
      names.emplace_back(a->Name());
    }
    for (const std::string& name : names) translate_attribute(robot, element, name);
  }
  for (XMLElement* const child : inside) translate(robot, *child);
}

/// The folder of all assets.
void write_folders(MjcfDocument& document) {
  for (auto* compiler : children(document.root(), "compiler")) {
    const std::string folder(attribute(*compiler, "assetdir"));
    for (const char* own : {"meshdir", "texturedir"}) {
      if (!folder.empty() && compiler->Attribute(own) == nullptr) {
        document.set(*compiler, own, folder);
      }
    }
  }
}

}  // namespace

void translate_later_versions(RobotFile& robot) {
  write_folders(robot.document);
  translate(robot, robot.document.root());
}

}  // namespace touchdown::models
