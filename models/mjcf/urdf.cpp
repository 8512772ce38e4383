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
std::string root_link(const XMLElement& robot) {
  std::set<std::string> held;
  for (auto* joint : children(robot, "joint")) held.insert(link_of(*joint, "child"));
  for (auto* link : children(robot, "link")) {
    std::string name(attribute(*link, "name"));
    if (!held.contains(name)) return name;
  }
  return {};
}

std::vector<std::string> links_of(const XMLElement& robot) {
  std::vector<std::string> names;
  for (auto* link : children(robot, "link")) {
    names.emplace_back(attribute(*link, "name"));
  }
  return names;
}

/// Removes what is only drawn, and writes the addresses of meshes as files.
void prepare(MjcfDocument& urdf) {
  for_each_element(urdf.root(), [&](XMLElement& element) {
    const std::string_view tag = element.Name();
    if (tag.starts_with("xacro:")) {
      urdf.fail(element, fmt::format("{}: expected a URDF, found xacro: `xacro {} > robot.urdf` "
                                     "writes one",
                                     tag, urdf.file().filename().string()));
    }
    if (tag == "link") {
      while (XMLElement* const visual = element.FirstChildElement("visual")) {
        urdf.remove(*visual);
      }
    }
    if (tag != "mesh" || element.Attribute("filename") == nullptr) return;
    const std::string_view address = attribute(element, "filename");
    const std::filesystem::path file = urdf_asset(address, urdf.file());
    if (file.empty()) {
      urdf.fail(element, fmt::format("mesh '{}': no such file; it is a collider", address));
    }
    const std::string fault = fault_of_mesh(file);
    if (!fault.empty()) urdf.fail(element, fmt::format("mesh '{}': {}", address, fault));
    element.SetAttribute("filename", file.c_str());
  });
}

/// The link that floats by default: the root, or the first link with a mass below it. ROS has links
/// without mass above it, such as `world` and `base_footprint`.
std::string floating_link(const MjcfDocument& urdf) {
  const XMLElement& robot = urdf.root();
  std::string link = root_link(robot);
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
    if (below.empty()) return link;
    link = below;
  }
  return link;
}

bool is_free(const XMLElement& joint) {
  return std::string_view(joint.Name()) == "freejoint" || attribute(joint, "type") == "free";
}

/// Lets a body float: it becomes the child of the world, with a free joint.
void let_float(MjcfDocument& mjcf, const std::string& base) {
  XMLElement* const body = mjcf.find("body", base);
  XMLElement* const world = mjcf.root().FirstChildElement("worldbody");
  if (body == nullptr || world == nullptr) {
    mjcf.fail(mjcf.root(), fmt::format("base: expected a body of the link '{}'", base));
  }
  XMLElement* const joint = body->FirstChildElement("joint");
  if (joint != nullptr && !is_free(*joint)) {
    mjcf.fail(*body, fmt::format("base: link '{}': expected fixed joints alone above it", base));
  }
  if (body->Parent() != world) world->InsertEndChild(body);
  if (joint != nullptr || body->FirstChildElement("freejoint") != nullptr) return;
  body->InsertFirstChild(mjcf.root().GetDocument()->NewElement("freejoint"));
}

}  // namespace

std::filesystem::path urdf_asset(std::string_view address, const std::filesystem::path& urdf) {
  constexpr std::string_view package = "package://";
  constexpr std::string_view plain = "file://";
  std::vector<std::filesystem::path> candidates;
  const std::filesystem::path folder = absolute_path(urdf).parent_path();
  if (address.starts_with(package)) {
    const std::filesystem::path path(address.substr(package.size()));
    const std::filesystem::path inside = path.lexically_relative(*path.begin());
    for (std::filesystem::path above = folder;; above = above.parent_path()) {
      candidates.insert(candidates.end(), {above / path, above / inside});
      if (above == above.parent_path()) break;
    }
  } else {
    candidates.push_back(folder /
                         (address.starts_with(plain) ? address.substr(plain.size()) : address));
  }
  candidates.push_back(folder / std::filesystem::path(address).filename());
  for (const std::filesystem::path& file : candidates) {
    std::error_code ignored;
    if (std::filesystem::is_regular_file(file, ignored)) return file.lexically_normal();
  }
  return {};
}

ConvertedUrdf converted_urdf(const std::filesystem::path& file, const std::string& base) {
  MjcfDocument urdf = MjcfDocument::load(file);
  XMLElement& robot = urdf.root();
  const std::string floating = base.empty() ? floating_link(urdf) : base;
  if (urdf.find("link", floating) == nullptr) {
    urdf.fail(robot, fmt::format("base: expected a link named '{}'{}", floating,
                                 did_you_mean(floating, links_of(robot))));
  }
  prepare(urdf);
  ConvertedUrdf converted;
  for (auto* joint : children(robot, "joint")) {
    if (joint->FirstChildElement("mimic") != nullptr) {
      urdf.fail(*joint, fmt::format("{}: expected no <mimic>: coupled joints are not supported",
                                    title_of(*joint)));
    }
    const XMLElement* const limit = joint->FirstChildElement("limit");
    const double effort = limit == nullptr ? 0.0 : limit->DoubleAttribute("effort");
    if (effort > 0.0) converted.effort[std::string(attribute(*joint, "name"))] = effort;
  }
  XMLElement* const first = robot.FirstChildElement();
  urdf.insert_before(*first,
                     "<mujoco><compiler fusestatic=\"false\" strippath=\"false\"/></mujoco>");
  converted.mjcf = MjcfDocument::converted(converted_to_mjcf(urdf.text(""), file), urdf);
  let_float(converted.mjcf, floating);
  return converted;
}

}  // namespace touchdown::models
