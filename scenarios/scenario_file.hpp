#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/key.hpp"
#include "core/yaml.hpp"
#include "scenarios/scenario.hpp"

namespace touchdown::scenarios {

/// Reads a scenario file and completes it from its robot's file, which `find_resource` finds. The
/// robot's file provides stance and balancer where the scenario does not; either may specify
/// `gains: lqr`. Forces with `forces_for_mass` are scaled to the robot's mass. The result holds
/// numbers only, so `scenario_from_yaml` reads it back without the robot.
/// Errors: `InputError` with file:line:column of either file.
Scenario complete_scenario(const YamlDocument& document);

/// The keys of a YAML file about a robot, those that its balancer reads included.
std::vector<Key> robot_keys();

}  // namespace touchdown::scenarios
