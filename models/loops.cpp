#include <fmt/format.h>
#include <fmt/ranges.h>

#include "models/robot_source.hpp"

namespace touchdown::models {

namespace {

using tinyxml2::XMLElement;

/// Checks that the bodies of a loop of the YAML file are there.
void check_bodies(const MjcfDocument& document, const LoopKeys& loop, const std::string& key,
                  const RobotKeys& keys) {
  for (const std::string& body : loop.bodies) {
    if (document.find("body", body) != nullptr) continue;
    keys.fail(key, missing(document, "body", body));
  }
}

/// Lets a connection of sites be one of their bodies. The anchors follow after compiling.
LoopEnds connect_bodies(MjcfDocument& document, XMLElement& connect) {
  LoopEnds ends;
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string key = fmt::format("site{}", i + 1);
    const std::string name = ends.sites[i] = attribute(connect, key.c_str());
    if (name.empty()) continue;
    XMLElement* const site = document.find("site", name);
    if (site == nullptr) {
      document.fail(connect, fmt::format("{}: {}: {}", title_of(connect), key,
                                         missing(document, "site", name)));
    }
    XMLElement& body = *site->Parent()->ToElement();
    if (body.Attribute("name") == nullptr) {
      document.set(body, "name", fmt::format("{}body_of_{}", own_prefix, name));
    }
    document.replace(connect, key.c_str(), fmt::format("body{}", i + 1),
                     std::string(attribute(body, "name")));
    if (i == 0) document.set(connect, "anchor", "0 0 0");
  }
  return ends;
}

}  // namespace

void complete_loops(RobotFile& robot, const PartNames& parts, const RobotKeys& keys) {
  for (XMLElement* const connect : in_sections(robot.document.root(), "equality")) {
    robot.ends.push_back(connect_bodies(robot.document, *connect));
  }
  for (std::size_t i = 0; i < parts.loops.size(); ++i) {
    const LoopKeys& loop = parts.loops[i];
    const std::string key = fmt::format("loops.{}", i);
    check_bodies(robot.document, loop, key, keys);
    robot.loops += fmt::format(
        "<equality><connect name=\"{}\" body1=\"{}\" body2=\"{}\" anchor=\"{}\"/></equality>", key,
        loop.bodies[0], loop.bodies[1], fmt::join(loop.anchor, " "));
    robot.ends.push_back({{}, loop.second_anchor});
  }
}

}  // namespace touchdown::models
