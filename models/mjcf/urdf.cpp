#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <memory>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "core/files.hpp"
#include "models/mjcf/assets.hpp"
#include "models/mjcf/compiler.hpp"
#include "models/mjcf/robot_file.hpp"

namespace touchdown::models {

namespace {

using tinyxml2::XMLElement;

/// The command that brings a missing mesh beside the URDF.
std::string remedy_for(std::string_view address) {
  if (!address.starts_with(package_address)) return {};
  const std::filesystem::path path(address.substr(package_address.size()));
  return fmt::format(" (`cp \"$(ros2 pkg prefix --share {})/{}\" .` copies it)",
                     path.begin()->string(), path.lexically_relative(*path.begin()).string());
}

/// Removes a collider without its file. Errors: `InputError` if its link has its mass from it.
void drop_collider(MjcfDocument& urdf, XMLElement& collider, std::string_view address,
                   std::vector<std::string>& ignored) {
  const XMLElement& link = *collider.Parent()->ToElement();
  const std::string missing =
      fmt::format("mesh '{}': no such file{}", address, remedy_for(address));
  if (link.FirstChildElement("inertial") == nullptr) {
    urdf.fail(collider, missing + ", and its link has no <inertial>");
  }
  ignored.push_back(fmt::format("{}: {}: {} does not touch with it", urdf.place_of(collider),
                                missing, title_of(link)));
  urdf.remove(collider);
}

/// Attributes of links and joints that are three numbers, and those that are one.
constexpr std::array triples = {"xyz", "rpy", "size", "scale"};
constexpr std::array single_numbers = {"value", "ixx",    "ixy",     "ixz",     "iyy",
                                       "iyz",   "izz",    "radius",  "length",  "lower",
                                       "upper", "effort", "damping", "friction"};

/// Refuses attributes of a link or joint that are not as many numbers as expected: MuJoCo takes
/// what it cannot read for 0.
void check_numbers(const MjcfDocument& urdf, XMLElement& part) {
  for_each_element(part, [&](const XMLElement& element) {
    const auto require = [&](const char* name, std::size_t count, const char* expected) {
      if (element.Attribute(name) == nullptr) return;
      const std::vector<double> found = numbers(attribute(element, name));
      if (found.size() == count &&
          std::ranges::none_of(found, [](double x) { return std::isnan(x); })) {
        return;
      }
      urdf.fail(element, fmt::format("{}: {}: {}: expected {}, found '{}'", title_of(part),
                                     element.Name(), name, expected, attribute(element, name)));
    };
    for (const char* const name : triples) require(name, 3, "three numbers with spaces between");
    for (const char* const name : single_numbers) require(name, 1, "a number");
  });
}

/// Removes what is only drawn, and writes the addresses of meshes as files. Returns what is
/// ignored.
std::vector<std::string> prepare(MjcfDocument& urdf) {
  std::vector<std::string> ignored;
  urdf.visit([&](const XMLElement& element) {
    if (!std::string_view(element.Name()).starts_with("xacro:")) return;
    const std::string file = urdf.file().filename().string();
    urdf.fail(element,
              fmt::format("{}: expected a URDF, found xacro: `xacro {} > {}` writes one",
                          element.Name(), file, file.substr(0, file.find('.')) + "_flat.urdf"));
  });
  const std::string meshdir = mesh_folder(urdf);
  for (auto* link : children(urdf.root(), "link")) {
    for (auto* visual : children(*link, "visual")) urdf.remove(*visual);
    check_numbers(urdf, *link);
    for (auto* collider : children(*link, "collision")) {
      XMLElement* const geometry = collider->FirstChildElement("geometry");
      XMLElement* const mesh = geometry == nullptr ? nullptr : geometry->FirstChildElement("mesh");
      if (mesh == nullptr) continue;
      const std::string address(attribute(*mesh, "filename"));
      const std::filesystem::path file = urdf_asset(address, urdf.file(), meshdir);
      if (!file.empty()) {
        const std::string fault = fault_of_mesh(file);
        if (!fault.empty()) urdf.fail(*mesh, fmt::format("mesh '{}': {}", address, fault));
        urdf.replace(*mesh, "filename", "filename", file.string());
      } else if (geometry->FirstChildElement() != geometry->LastChildElement()) {
        urdf.remove(*mesh);  // another shape stands beside it
      } else {
        drop_collider(urdf, *collider, address, ignored);
      }
    }
  }
  return ignored;
}

/// Reduces MuJoCo's own section of a URDF to what sets masses.
void reduce_mujoco_section(MjcfDocument& urdf, std::vector<std::string>& ignored) {
  std::string kept;
  for (XMLElement* const compiler : in_sections(urdf.root(), "mujoco", "compiler")) {
    for (const char* name : {"balanceinertia", "boundmass", "boundinertia", "settotalmass",
                             "inertiafromgeom", "inertiagrouprange"}) {
      if (compiler->Attribute(name) == nullptr || kept.find(name) != std::string::npos) continue;
      kept += fmt::format(" {}=\"{}\"", name, attribute(*compiler, name));
    }
  }
  for (auto* section : children(urdf.root(), "mujoco")) {
    ignored.push_back(urdf.place_of(*section) +
                      ": mujoco: what sets masses counts; the scene has its own options");
    urdf.remove(*section);
  }
  urdf.insert_first(
      urdf.root(),
      fmt::format("<mujoco><compiler fusestatic=\"false\" strippath=\"false\"{}/></mujoco>", kept));
}

bool has_mass(const XMLElement& body) { return body.FirstChildElement("inertial") != nullptr; }

bool is_free(const XMLElement& body) {
  return body.FirstChildElement("freejoint") != nullptr ||
         (body.FirstChildElement("joint") != nullptr &&
          attribute(*body.FirstChildElement("joint"), "type") == "free");
}

bool is_fixed(const XMLElement& body) { return body.FirstChildElement("joint") == nullptr; }

/// The body that floats by default: the root, or the first one with a mass below it. ROS has links
/// without mass above it, such as `world` and `base_footprint`. Null if there is none.
const XMLElement* floating_body(const XMLElement& above) {
  const XMLElement* found = nullptr;
  for (const XMLElement* const body : children(above, "body")) {
    if (!is_fixed(*body) && !is_free(*body)) continue;
    if (found == nullptr || has_mass(*body)) found = body;
  }
  if (found == nullptr || has_mass(*found)) return found;
  const XMLElement* const below = floating_body(*found);
  return below != nullptr && has_mass(*below) ? below : found;
}

/// Refuses a second root with a mass. MuJoCo takes a link `world` for the world.
void require_one_root(const MjcfDocument& mjcf, const MjcfDocument& urdf) {
  const XMLElement* root = nullptr;
  for (const XMLElement* const body : in_sections(mjcf.root(), "worldbody", "body")) {
    if (root != nullptr && has_mass(*body) && urdf.find("link", "world") == nullptr) {
      mjcf.fail(*body, fmt::format("link '{}': expected a joint with this child: '{}' is the root",
                                   attribute(*body, "name"), attribute(*root, "name")));
    }
    if (root == nullptr) root = body;
  }
}

/// The link that a joint names under `tag`, its "parent" or its "child".
std::string_view link_of(const XMLElement& joint, const char* tag) {
  const XMLElement* const end = joint.FirstChildElement(tag);
  return end == nullptr ? std::string_view() : attribute(*end, "link");
}

/// Fixes a robot to a root without a mass on which it moves, such as `world` with a planar joint:
/// its first link with a mass then floats as any other.
void fix_to_world(MjcfDocument& urdf, std::vector<std::string>& ignored) {
  const std::vector<XMLElement*> joints = children(urdf.root(), "joint");
  const auto moves = [&](std::string_view link) {
    return std::ranges::any_of(joints,
                               [&](auto* joint) { return link_of(*joint, "child") == link; });
  };
  for (const XMLElement* link : children(urdf.root(), "link")) {
    if (moves(attribute(*link, "name"))) continue;
    for (std::size_t i = 0; i < joints.size() && !has_mass(*link); ++i) {  // joints may be a cycle
      std::vector<XMLElement*> below;
      std::ranges::copy_if(joints, std::back_inserter(below), [&](auto* joint) {
        return link_of(*joint, "parent") == attribute(*link, "name");
      });
      if (below.size() != 1) break;
      link = urdf.find("link", link_of(*below[0], "child"));
      const std::string_view type = attribute(*below[0], "type");
      if (link == nullptr || type == "floating") break;
      if (type == "fixed") continue;
      ignored.push_back(fmt::format("{}: {}: to the world: the robot floats here",
                                    urdf.place_of(*below[0]), title_of(*below[0])));
      urdf.replace(*below[0], "type", "type", "fixed");
    }
  }
}

/// Lets a body float: it becomes the child of the world, with a free joint.
void let_float(MjcfDocument& mjcf, const std::string& base,
               const std::shared_ptr<const MjcfDocument>& urdf) {
  XMLElement* body = mjcf.find("body", base);
  if (!is_fixed(*body) && !is_free(*body)) {
    mjcf.fail(*body, fmt::format("base: link '{}': expected fixed joints alone above it", base));
  }
  if (!is_free(*body)) {
    mjcf.insert_last(*body, "<freejoint/>");
    mjcf = MjcfDocument::converted(mjcf.edited(), urdf);
    body = mjcf.find("body", base);
  }
  XMLElement* const world = mjcf.root().FirstChildElement("worldbody");
  if (body->Parent() == world) return;
  mjcf.insert_last(*world, mjcf.text_of(*body));
  mjcf.remove(*body);
  mjcf = MjcfDocument::converted(mjcf.edited(), urdf);
}

}  // namespace

RobotFile converted_urdf(MjcfDocument document, const std::string& base) {
  const auto urdf = std::make_shared<MjcfDocument>(std::move(document));
  XMLElement& root = urdf->root();
  if (root.FirstChildElement() == nullptr) urdf->fail(root, "robot: expected links and joints");
  std::vector<std::string> ignored = prepare(*urdf);
  fix_to_world(*urdf, ignored);
  reduce_mujoco_section(*urdf, ignored);
  std::vector<std::string> fixed;
  std::map<std::string, double> effort;
  for (auto* joint : children(root, "joint")) {
    check_numbers(*urdf, *joint);
    if (joint->FirstChildElement("mimic") != nullptr) {
      urdf->fail(*joint, fmt::format("{}: expected no <mimic>: coupled joints are not supported",
                                     title_of(*joint)));
    }
    const std::string name(attribute(*joint, "name"));
    if (attribute(*joint, "type") == "fixed") fixed.push_back(name);
    const XMLElement* const limit = joint->FirstChildElement("limit");
    const double most = limit == nullptr ? 0.0 : limit->DoubleAttribute("effort");
    if (most > 0.0) effort[name] = most;
  }
  MjcfDocument mjcf = MjcfDocument::converted(converted_to_mjcf(*urdf), urdf);
  require_one_root(mjcf, *urdf);
  const XMLElement* const world = mjcf.root().FirstChildElement("worldbody");
  const XMLElement* const usual = world == nullptr ? nullptr : floating_body(*world);
  const std::string floating =
      base.empty() && usual != nullptr ? std::string(attribute(*usual, "name")) : base;
  if (mjcf.find("body", floating) == nullptr) {
    urdf->fail(root, "base: " + missing(*urdf, "link", floating));
  }
  let_float(mjcf, floating, urdf);
  return {std::move(mjcf), std::move(ignored), {}, std::move(fixed), std::move(effort)};
}

}  // namespace touchdown::models
