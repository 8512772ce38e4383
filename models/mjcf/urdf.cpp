#include "models/mjcf/urdf.hpp"

#include <set>

#include <fmt/format.h>

#include "models/mjcf/compiler.hpp"

namespace touchdown::models {

namespace {

using tinyxml2::XMLElement;

std::string link_of(const XMLElement& joint, const char* end) {
  const XMLElement* const link = joint.FirstChildElement(end);
  return link == nullptr ? std::string() : std::string(attribute(*link, "link"));
}

/// The link that is no other link's child.
std::string root_link(const XMLElement& robot) {
  std::set<std::string> children;
  for (auto* joint = robot.FirstChildElement("joint"); joint != nullptr;
       joint = joint->NextSiblingElement("joint")) {
    children.insert(link_of(*joint, "child"));
  }
  for (auto* link = robot.FirstChildElement("link"); link != nullptr;
       link = link->NextSiblingElement("link")) {
    std::string name(attribute(*link, "name"));
    if (!children.contains(name)) return name;
  }
  return {};
}

/// Lets a body float: it becomes the child of the world, with a free joint.
void let_float(MjcfDocument& mjcf, const std::string& base) {
  XMLElement* const body = mjcf.find("body", base);
  XMLElement* const world = mjcf.root().FirstChildElement("worldbody");
  if (body == nullptr || world == nullptr) {
    mjcf.fail(mjcf.root(), fmt::format("base: expected a body of the link '{}'", base));
  }
  if (body->FirstChildElement("joint") != nullptr) {
    mjcf.fail(*body, fmt::format("base: link '{}': expected fixed joints alone above it", base));
  }
  if (body->Parent() != world) world->InsertEndChild(body);
  body->InsertFirstChild(mjcf.root().GetDocument()->NewElement("freejoint"));
}

}  // namespace

ConvertedUrdf converted_urdf(const std::filesystem::path& file, const std::string& base) {
  MjcfDocument urdf = MjcfDocument::load(file);
  XMLElement& robot = urdf.root();
  const std::string floating = base.empty() ? root_link(robot) : base;
  if (urdf.find("link", floating) == nullptr) {
    urdf.fail(robot, fmt::format("base: expected a link named '{}'", floating));
  }
  ConvertedUrdf converted;
  for (auto* joint = robot.FirstChildElement("joint"); joint != nullptr;
       joint = joint->NextSiblingElement("joint")) {
    if (joint->FirstChildElement("mimic") != nullptr) {
      urdf.fail(*joint, fmt::format("{}: expected no <mimic>: coupled joints are not supported",
                                    title_of(*joint)));
    }
    const XMLElement* const limit = joint->FirstChildElement("limit");
    const double effort = limit == nullptr ? 0.0 : limit->DoubleAttribute("effort");
    if (effort > 0.0) converted.effort[std::string(attribute(*joint, "name"))] = effort;
  }
  XMLElement* const first = robot.FirstChildElement();
  urdf.insert_before(*first, "<mujoco><compiler fusestatic=\"false\"/></mujoco>");
  converted.mjcf = MjcfDocument::parse(converted_to_mjcf(urdf.text(""), file), file);
  let_float(converted.mjcf, floating);
  return converted;
}

}  // namespace touchdown::models
