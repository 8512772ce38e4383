#include <algorithm>
#include <cmath>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include "models/mjcf/robot_file.hpp"

namespace touchdown::models {

namespace {

using tinyxml2::XMLElement;

/// Elements and attributes by the version that introduced them: from MuJoCo's changelog
/// (doc/changelog.rst of google-deepmind/mujoco), and from the notes of its releases 3.11.0 and
/// 3.12.0. `kv` and `timeconst` were no attributes of position servos before, and `inertia` none of
/// meshes.
const std::map<std::string, std::set<std::string>> features = {
    {"2.3.0", {"assetdir", "extension", "plugin"}},
    {"2.3.1", {"actdim", "gravcomp"}},
    {"2.3.6", {"tausmooth"}},
    {"2.3.7", {"actuatorforcelimited", "actuatorforcerange", "content_type"}},
    {"3.0.0",
     {"actearly", "actuatorfrclimited", "actuatorfrcrange", "deformable", "flex", "flexcomp",
      "focal", "focalpixel", "principal", "principalpixel", "resolution", "sensorsize"}},
    {"3.1.0", {"frame", "kv"}},
    {"3.1.3", {"inheritrange"}},
    {"3.1.4", {"actuatorgravcomp"}},
    {"3.1.5", {"bulbradius", "metallic", "replicate", "roughness"}},
    {"3.1.6", {"dampratio", "timeconst"}},
    {"3.2.0", {"attach", "maxhullvert", "orthographic"}},
    {"3.2.3", {"align", "alignfree"}},
    {"3.2.5", {"inertia", "layer"}},
    {"3.3.1", {"saveinertial"}},
    {"3.11.0", {"surfacevel"}},
    {"3.12.0", {"pid"}}};

/// Attributes that touchdown overrides: those of a servo's law, and of gravity on actuators.
const std::set<std::string, std::less<>> overridden = {"kv",
                                                       "dampratio",
                                                       "timeconst",
                                                       "inheritrange",
                                                       "actdim",
                                                       "actearly",
                                                       "actuatorfrcrange",
                                                       "actuatorforcerange",
                                                       "actuatorfrclimited",
                                                       "actuatorgravcomp",
                                                       "align",
                                                       "actuatorforcelimited"};
/// Elements of which nothing acts on the robot but what this version of MuJoCo reads, too.
const std::set<std::string, std::less<>> drawn = {"mesh", "texture", "material", "camera", "light",
                                                  "site", "skin",    "compiler", "layer"};
/// What another file would write instead.
const std::map<std::string, std::string, std::less<>> equivalents = {
    {"gravcomp", "the weight of all bodies counts"},
    {"surfacevel", "the ground is the scenario's terrain"},
    {"pid", "expected a <motor> or <position> with a forcerange"}};

std::string equivalent_of(std::string_view name) {
  const auto found = equivalents.find(name);
  if (found != equivalents.end()) return found->second;
  return "MuJoCo 3 writes a file without it: `python3 -c \"import mujoco as m; "
         "m.mj_saveLastXML('flat.xml', m.MjModel.from_xml_path('robot.xml'))\"`";
}

std::string version_text(std::string_view name) {
  for (const auto& [version, names] : features) {
    if (!names.contains(std::string(name))) continue;
    return fmt::format("`{}` came with MuJoCo {}; this is MuJoCo {}: {}", name, version,
                       mj_versionString(), equivalent_of(name));
  }
  return fmt::format("unrecognized: this is MuJoCo {}, `{}` may be of a later version",
                     mj_versionString(), name);
}

/// The attributes that this version of MuJoCo reads, by section and tag, such as "asset/mesh".
using Schema = std::map<std::string, std::set<std::string>>;

Schema read_schema() {
  constexpr int most = 1 << 18;
  std::string text(most, '\0');
  text.resize(static_cast<std::size_t>(mj_printSchema(nullptr, text.data(), most, 0, 0)));
  const std::regex element(R"(^( *)(\S+) +\(.\)(.*)$)");
  Schema schema = {{"worldbody/worldbody", {}}, {"default/default", {"class"}}};
  std::string section;
  std::set<std::string>* attributes = nullptr;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (std::regex_match(line, match, element)) {
      constexpr int indent = 3;
      const bool is_body = match[2] == "(world)body";
      if (match[1].length() == indent) section = is_body ? "worldbody" : match[2].str();
      attributes = &schema[section + "/" + (is_body ? "body" : match[2].str())];
      line = match[3].str();
    }
    std::istringstream words(line);
    for (std::string word; words >> word;) {
      if (attributes != nullptr) attributes->insert(word);
    }
  }
  return schema;
}

class Translation {
 public:
  Translation(MjcfDocument& document, FileFindings& findings)
      : document_(document), findings_(findings) {}

  void translate() {
    for (XMLElement* const section : children(document_.root())) {
      const std::string_view tag = section->Name();
      // Those that `keep_robot_only` refuses have one complaint already.
      if (tag == "equality" || tag == "tendon" || tag == "extension") continue;
      translate(*section, std::string(tag));
    }
  }

 private:
  void complain(const XMLElement& element, std::string_view name) {
    findings_.complaints.push_back(fmt::format("{}: {}: {}", document_.place_of(element),
                                               title_of(element), version_text(name)));
  }
  void ignore(const XMLElement& element, std::string_view name) {
    findings_.ignored.push_back(
        fmt::format("{}: {}: {}: of a later MuJoCo, and without effect here",
                    document_.place_of(element), title_of(element), name));
  }

  void translate(XMLElement& element, const std::string& section) {
    const auto known = schema_.find(section + "/" + element.Name());
    if (known == schema_.end()) {
      if (splice(element)) return;
      if (!drawn.contains(element.Name())) return complain(element, element.Name());
      ignore(element, element.Name());
      return document_.remove(element);
    }
    for (const auto* a = element.FirstAttribute(); a != nullptr;) {
      const std::string name = a->Name();
      a = a->Next();
      if (known->second.contains(name)) continue;
      if (!is_without_effect(element, name)) {
        complain(element, name);
        continue;
      }
      if (name.find("frc") == std::string::npos && name.find("force") == std::string::npos) {
        ignore(element, name);
      }
      element.DeleteAttribute(name.c_str());
    }
    for (XMLElement* const child : children(element)) translate(*child, section);
  }

  bool is_without_effect(const XMLElement& element, const std::string& name) const {
    const std::string_view tag = element.Name();
    if (drawn.contains(tag) || overridden.contains(name)) return true;
    if (name == "gravcomp" || name == "surfacevel") {
      const std::vector<double> values = numbers(attribute(element, name.c_str()));
      return std::all_of(values.begin(), values.end(), [](double x) { return x == 0.0; });
    }
    return tag == "geom" && is_visual(document_, element);
  }

  /// Puts the children of a <frame> without a pose in its place.
  bool splice(XMLElement& frame) {
    const auto* const only = frame.FirstAttribute();
    if (std::string_view(frame.Name()) != "frame" ||
        (only != nullptr && (std::string_view(only->Name()) != "name" || only->Next() != nullptr)))
      return false;
    for (XMLElement* const child : children(frame)) {
      document_.move_before(frame, *child);
      translate(*child, "worldbody");
    }
    document_.remove(frame);
    return true;
  }

  MjcfDocument& document_;
  FileFindings& findings_;
  const Schema schema_ = read_schema();
};

/// The value of an actuator's attribute; its class may give it to any kind of actuator.
std::vector<double> values_of(const MjcfDocument& document, const XMLElement& actuator,
                              const char* name) {
  return numbers(attribute_or_default(document, actuator, name));
}

double first_of(const std::vector<double>& values, double otherwise) {
  return values.empty() ? otherwise : values.front();
}

std::vector<XMLElement*> all_actuators(MjcfDocument& document) {
  std::vector<XMLElement*> all;
  for (auto* section : children(document.root(), "actuator")) {
    for (auto* actuator : children(*section)) all.push_back(actuator);
  }
  return all;
}

/// A position servo with damping is an affine one for this version of MuJoCo.
void write_damping(MjcfDocument& document) {
  for (XMLElement* const servo : all_actuators(document)) {
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

/// Limits the motors of a joint to the torque that the joint lets them have.
void limit_motors(MjcfDocument& document, std::string_view joint, double limit) {
  for (XMLElement* const motor : all_actuators(document)) {
    if (attribute(*motor, "joint") != joint) continue;
    const double gear = std::abs(first_of(values_of(document, *motor, "gear"), 1.0));
    const std::vector<double> own = values_of(document, *motor, "forcerange");
    if (gear == 0.0 || (own.size() == 2 && own[1] * gear <= limit)) continue;
    motor->SetAttribute("forcelimited", "true");
    motor->SetAttribute("forcerange", fmt::format("{} {}", -limit / gear, limit / gear).c_str());
  }
}

void write_limits(MjcfDocument& document, FileFindings& findings) {
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
        limit_motors(document, attribute(joint, "name"), ends[1]);
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
  write_limits(document, findings);
  Translation(document, findings).translate();
}

}  // namespace touchdown::models
