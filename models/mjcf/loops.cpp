#include <array>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "models/mjcf/parts.hpp"

namespace touchdown::models {

namespace {

using tinyxml2::XMLElement;

/// Adds a loop of the YAML file: a connection of two new sites, or of bodies at an anchor.
void add_loop(MjcfDocument& document, const LoopKeys& loop, std::size_t number,
              const RobotKeys& keys) {
  std::array<XMLElement*, 2> body = {};
  for (std::size_t i = 0; i < 2; ++i) {
    body[i] = &named(document, {"body"}, loop.bodies[i], fmt::format("loops.{}", number), keys);
  }
  XMLElement& connect = document.add_to_section("equality", "connect", *body[1]);
  connect.SetAttribute("name", fmt::format("loops.{}", number).c_str());
  const auto text = [](const std::vector<double>& place) {
    return fmt::format("{}", fmt::join(place, " "));
  };
  if (loop.second_anchor.empty()) {
    connect.SetAttribute("body1", loop.bodies[0].c_str());
    connect.SetAttribute("body2", loop.bodies[1].c_str());
    connect.SetAttribute("anchor", text(loop.anchor).c_str());
    return;
  }
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string name = fmt::format("touchdown_loop_{}_{}", number, i);
    XMLElement& site = document.add(*body[i], "site", *body[i]);
    site.SetAttribute("name", name.c_str());
    site.SetAttribute("pos", text(i == 0 ? loop.anchor : loop.second_anchor).c_str());
    connect.SetAttribute(i == 0 ? "site1" : "site2", name.c_str());
  }
}

/// Lets a connection of sites be one of their bodies. The anchors follow after compiling.
LoopSites bodies_of_sites(MjcfDocument& document, XMLElement& connect) {
  if (connect.Attribute("site1") == nullptr) return {};
  constexpr std::array<const char*, 2> keys = {"site1", "site2"};
  std::array<std::string, 2> names;
  for (std::size_t i = 0; i < 2; ++i) {
    names[i] = attribute(connect, keys[i]);
    connect.DeleteAttribute(keys[i]);
  }
  for (std::size_t i = 0; i < 2; ++i) {
    XMLElement* const site = document.find("site", names[i]);
    if (site == nullptr) {
      document.fail(connect, fmt::format("{}: {}: {}", title_of(connect), keys[i],
                                         missing(document, {"site"}, names[i])));
    }
    XMLElement& body = *site->Parent()->ToElement();
    if (body.Attribute("name") == nullptr) {
      body.SetAttribute("name", fmt::format("touchdown_body_of_{}", names[i]).c_str());
    }
    connect.SetAttribute(i == 0 ? "body1" : "body2", body.Attribute("name"));
  }
  connect.SetAttribute("anchor", "0 0 0");
  return {names[0], names[1]};
}

}  // namespace

std::vector<LoopSites> complete_loops(MjcfDocument& document, const PartNames& parts,
                                      FileFindings& findings, const RobotKeys& keys) {
  for (std::size_t i = 0; i < parts.loops.size(); ++i) {
    collect(findings.complaints, [&] { add_loop(document, parts.loops[i], i, keys); });
  }
  std::vector<LoopSites> sites;
  for (XMLElement* const connect : in_sections(document.root(), "equality")) {
    sites.emplace_back();
    collect(findings.complaints, [&] { sites.back() = bodies_of_sites(document, *connect); });
  }
  for (std::size_t leg = 0; leg < wheel_count; ++leg) {
    for (std::size_t i = 0; i < parts.motors[leg].size(); ++i) {
      collect(findings.complaints, [&] {
        const std::string& name = parts.motors[leg][i];
        const XMLElement& joint =
            named(document, {"joint"}, name,
                  fmt::format("motors.{}.{}", leg == 0 ? "left" : "right", i), keys);
        if (only_motor_of(document, name) == nullptr) {
          add_motor(document, joint).SetAttribute("joint", name.c_str());
        }
      });
    }
  }
  return sites;
}

}  // namespace touchdown::models
