#pragma once

#include <filesystem>

#include "core/yaml.hpp"
#include "scenarios/scenario.hpp"

namespace touchdown::scenarios {

/// The scenario that somebody wrote: its robot is where `find_resource` finds it, and what the
/// scenario does not say about stance and balancer the robot's own file does, `gains: lqr` in
/// either among it. Forces that are meant for a robot of one mass it gets in proportion to its own.
/// Everything is a number afterwards, which `scenario_from_yaml` reads back without the robot.
/// Errors: `InputError` with file:line:column, of whichever file.
Scenario complete_scenario(const YamlDocument& document);

/// The same of a file that something else names, which is where `find_resource` finds it; with
/// another robot, if one is named.
Scenario find_scenario(const std::filesystem::path& path, const std::string& robot = {});

}  // namespace touchdown::scenarios
