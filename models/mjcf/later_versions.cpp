#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include "core/yaml.hpp"
#include "models/mjcf/robot_file.hpp"

namespace touchdown::models {

namespace {

using tinyxml2::XMLElement;

constexpr std::string_view flattened =
    "MuJoCo 3 writes a file without it: `python3 -c \"import mujoco as m; "
    "m.mj_saveLastXML('flat.xml', m.MjModel.from_xml_path('robot.xml'))\"`";
constexpr std::string_view rigid = "deformable bodies are not simulated";

struct Addition {
  std::string_view version;
  std::string_view instead;
};
/// What later versions added and what acts on the robot, from MuJoCo's changelog (doc/changelog.rst
/// of google-deepmind/mujoco), and from the notes of its releases 3.11.0 and 3.12.0.
const std::map<std::string_view, Addition> additions = {
    {"plugin", {"2.3.0", "plugins are not run"}},
    {"gravcomp", {"2.3.1", "the weight of all bodies counts"}},
    {"deformable", {"3.0.0", rigid}},
    {"flexcomp", {"3.0.0", rigid}},
    {"frame", {"3.1.0", flattened}},
    {"replicate", {"3.1.5", flattened}},
    {"attach", {"3.2.0", flattened}},
    {"surfacevel", {"3.11.0", "the ground is the scenario's terrain"}},
    {"pid", {"3.12.0", "expected a <motor> or <position> with a forcerange"}}};

/// Attributes that touchdown overrides, such as those of a servo's law, or that are translated.
const std::set<std::string_view> overridden = {
    "kv",           "dampratio",        "timeconst",          "inheritrange",
    "actdim",       "actearly",         "actuatorfrcrange",   "actuatorfrclimited",
    "align",        "actuatorgravcomp", "actuatorforcerange", "actuatorforcelimited",
    "alignfree",    "saveinertial",     "assetdir",           "inertia",
    "content_type", "maxhullvert"};
/// Elements that do not act on the robot.
const std::set<std::string_view> drawn = {"texture", "material", "camera", "light",
                                          "site",    "skin",     "layer"};

std::string version_text(std::string_view name, const std::vector<std::string>& known) {
  if (const auto found = additions.find(name); found != additions.end()) {
    return fmt::format("`{}` came with MuJoCo {}; this is MuJoCo {}: {}", name,
                       found->second.version, mj_versionString(), found->second.instead);
  }
  return fmt::format("unrecognized: this is MuJoCo {}, `{}` may be of a later version{}",
                     mj_versionString(), name, did_you_mean(name, known));
}

/// The attributes that this version of MuJoCo reads, by tag.
std::map<std::string, std::set<std::string>> read_schema() {
  constexpr int most = 1 << 18;
  std::string text(most, '\0');
  text.resize(static_cast<std::size_t>(mj_printSchema(nullptr, text.data(), most, 0, 0)));
  std::map<std::string, std::set<std::string>> schema = {{"worldbody", {}}};
  std::istringstream words(text + " end");
  std::set<std::string>* attributes = nullptr;
  std::string name;
  // Each tag is followed by how often it may occur, such as "(*)", and by its attributes.
  for (std::string word; words >> word;) {
    if (word.size() == 3 && word.front() == '(') {
      attributes = &schema[name == "(world)body" ? "body" : name];
      name.clear();
      continue;
    }
    if (attributes != nullptr && !name.empty()) attributes->insert(name);
    name = word;
  }
  return schema;
}

class Translation {
 public:
  Translation(MjcfDocument& document, FileFindings& findings)
      : document_(document), findings_(findings) {}

  void translate(XMLElement& element) {
    const auto known = schema_.find(element.Name());
    if (known == schema_.end()) return translate_unknown(element);
    for (const auto* a = element.FirstAttribute(); a != nullptr;) {
      const std::string name = a->Name();
      a = a->Next();
      if (known->second.contains(name)) continue;
      const bool is_ignored = is_without_effect(element, name);
      if (!name.starts_with("actuatorf")) {
        note(element, name, is_ignored, {known->second.begin(), known->second.end()});
      }
      if (is_ignored) element.DeleteAttribute(name.c_str());
    }
    for (XMLElement* const child : children(element)) translate(*child);
  }

 private:
  /// `known`: the names among which it may have been meant.
  void note(const XMLElement& element, std::string_view name, bool is_ignored,
            const std::vector<std::string>& known) {
    (is_ignored ? findings_.ignored : findings_.complaints)
        .push_back(fmt::format(
            "{}: {}: {}", document_.place_of(element), title_of(element),
            is_ignored ? fmt::format("{}: of a later MuJoCo, and without effect here", name)
                       : version_text(name, known)));
  }

  void translate_unknown(XMLElement& element) {
    const std::string_view tag = element.Name();
    const auto* const first = element.FirstAttribute();
    const bool has_pose =
        first != nullptr && (std::string_view(first->Name()) != "name" || first->Next() != nullptr);
    if (tag == "frame" && !has_pose) {
      for (XMLElement* const child : children(element)) {
        document_.move_before(element, *child);
        translate(*child);
      }
    } else {
      std::vector<std::string> tags;
      for (const auto& [known, attributes] : schema_) tags.push_back(known);
      note(element, tag, drawn.contains(tag), tags);
      if (!drawn.contains(tag)) return;
    }
    document_.remove(element);
  }

  bool is_without_effect(const XMLElement& element, const std::string& name) const {
    const std::string_view value = attribute(element, name.c_str());
    if (name == "inertia" && value == "shell") return false;
    if (drawn.contains(element.Name()) || overridden.contains(name)) return true;
    if (name == "gravcomp" || name == "surfacevel") {
      const std::vector<double> values = numbers(value);
      return std::all_of(values.begin(), values.end(), [](double x) { return x == 0.0; });
    }
    return std::string_view(element.Name()) == "geom" && is_visual(document_, element);
  }

  MjcfDocument& document_;
  FileFindings& findings_;
  const std::map<std::string, std::set<std::string>> schema_ = read_schema();
};

/// The value of an actuator's attribute; its class may give it to any kind of actuator.
std::vector<double> values_of(const MjcfDocument& document, const XMLElement& actuator,
                              const char* name) {
  return numbers(attribute_or_default(document, actuator, name));
}

double first_of(const std::vector<double>& values, double otherwise) {
  return values.empty() ? otherwise : values.front();
}

/// A position servo with damping is an affine one for this version of MuJoCo.
void write_damping(MjcfDocument& document) {
  for (XMLElement* const servo : in_sections(document.root(), "actuator")) {
    const double kv = first_of(values_of(document, *servo, "kv"), 0.0);
    if (std::string_view(servo->Name()) != "position" || kv == 0.0) continue;
    const double kp = first_of(values_of(document, *servo, "kp"), 1.0);
    servo->DeleteAttribute("kp");
    servo->SetName("general");
    servo->SetAttribute("biastype", "affine");
    servo->SetAttribute("gainprm", kp);
    servo->SetAttribute("biasprm", fmt::format("0 {} {}", -kp, -kv).c_str());
  }
}

/// Finds the torque limits of joints.
void find_limits(MjcfDocument& document, FileFindings& findings) {
  for (auto* world : children(document.root(), "worldbody")) {
    for_each_element(*world, [&](XMLElement& joint) {
      if (std::string_view(joint.Name()) != "joint") return;
      for (const std::string name : {"actuatorfrc", "actuatorforce"}) {
        const std::string range = name + "range";
        const std::vector<double> ends =
            numbers(attribute_or_default(document, joint, range.c_str()));
        if (ends.empty() ||
            attribute_or_default(document, joint, (name + "limited").c_str()) == "false")
          continue;
        constexpr double close = 1e-6;
        if (ends.size() != 2 || !(ends[1] > 0.0) ||
            !(std::abs(ends[0] + ends[1]) <= close * ends[1])) {
          findings.complaints.push_back(fmt::format(
              "{}: {}: {}: expected a symmetric range, found \"{}\"", document.place_of(joint),
              title_of(joint), range, attribute_or_default(document, joint, range.c_str())));
          continue;
        }
        findings.effort[std::string(attribute(joint, "name"))] = ends[1];
      }
    });
  }
}

/// The folder of all assets.
void write_folders(MjcfDocument& document) {
  for (auto* compiler : children(document.root(), "compiler")) {
    const std::string folder(attribute(*compiler, "assetdir"));
    for (const char* own : {"meshdir", "texturedir"}) {
      if (!folder.empty() && compiler->Attribute(own) == nullptr) {
        compiler->SetAttribute(own, folder.c_str());
      }
    }
  }
}

}  // namespace

void translate_later_versions(MjcfDocument& document, FileFindings& findings) {
  write_folders(document);
  write_damping(document);
  find_limits(document, findings);
  Translation(document, findings).translate(document.root());
}

}  // namespace touchdown::models
