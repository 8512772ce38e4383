#include <memory>
#include <set>
#include <system_error>

#include <fmt/format.h>

#include "core/files.hpp"
#include "core/yaml.hpp"
#include "models/mjcf/compiler.hpp"
#include "models/mjcf/robot_file.hpp"

namespace touchdown::models {

namespace {

using tinyxml2::XMLElement;

std::string link_of(const XMLElement& joint, const char* end) {
  const XMLElement* const link = joint.FirstChildElement(end);
  return link == nullptr ? std::string() : std::string(attribute(*link, "link"));
}

/// The link that is no other link's child.
std::string root_link(const MjcfDocument& urdf) {
  const XMLElement& robot = urdf.root();
  std::set<std::string> held;
  for (auto* joint : children(robot, "joint")) held.insert(link_of(*joint, "child"));
  std::string root;
  for (auto* link : children(robot, "link")) {
    const std::string name(attribute(*link, "name"));
    if (held.contains(name)) continue;
    if (!root.empty() && link->FirstChildElement("inertial") != nullptr) {
      urdf.fail(*link, fmt::format("{}: expected a joint with this child: '{}' is the root",
                                   title_of(*link), root));
    }
    if (root.empty()) root = name;
  }
  return root;
}

std::vector<std::string> links_of(const XMLElement& robot) {
  std::vector<std::string> names;
  for (auto* link : children(robot, "link")) {
    names.emplace_back(attribute(*link, "name"));
  }
  return names;
}

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

/// The link that floats by default: the root, or the first link with a mass below it. ROS has links
/// without mass above it, such as `world` and `base_footprint`.
std::string floating_link(const MjcfDocument& urdf) {
  const XMLElement& robot = urdf.root();
  std::string link = root_link(urdf);
  const auto has_mass = [&](const std::string& name) {
    const XMLElement* const element = urdf.find("link", name);
    return element != nullptr && element->FirstChildElement("inertial") != nullptr;
  };
  while (!has_mass(link)) {
    std::string below;
    for (auto* joint : children(robot, "joint")) {
      const std::string_view type = attribute(*joint, "type");
      const std::string child = link_of(*joint, "child");
      if (link_of(*joint, "parent") != link || (type != "fixed" && type != "floating")) continue;
      if (below.empty() || has_mass(child)) below = child;
    }
    if (below.empty()) return root_link(urdf);
    link = below;
  }
  return link;
}

/// Lets a body float: it becomes the child of the world, with a free joint.
void let_float(MjcfDocument& mjcf, const std::string& base,
               const std::shared_ptr<const MjcfDocument>& urdf) {
  XMLElement* body = mjcf.find("body", base);
  if (body == nullptr) {
    mjcf.fail(mjcf.root(), fmt::format("base: expected a body of the link '{}'", base));
  }
  const XMLElement* const joint = body->FirstChildElement("joint");
  const bool is_free = body->FirstChildElement("freejoint") != nullptr ||
                       (joint != nullptr && attribute(*joint, "type") == "free");
  if (joint != nullptr && !is_free) {
    mjcf.fail(*body, fmt::format("base: link '{}': expected fixed joints alone above it", base));
  }
  if (!is_free) {
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
  reduce_mujoco_section(*urdf, ignored);
  const std::string usual = floating_link(*urdf);
  const std::string& floating = base.empty() ? usual : base;
  if (urdf->find("link", floating) == nullptr) {
    urdf->fail(root, fmt::format("base: expected a link named '{}'{}", floating,
                                 did_you_mean(floating, links_of(root))));
  }
  std::vector<std::string> fixed;
  std::map<std::string, double> effort;
  for (auto* joint : children(root, "joint")) {
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
  let_float(mjcf, floating, urdf);
  return {std::move(mjcf), std::move(ignored), {}, std::move(fixed), std::move(effort)};
}

}  // namespace touchdown::models
