#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/key.hpp"
#include "core/yaml.hpp"
#include "scenarios/scenario.hpp"

namespace touchdown::models {
struct RobotModel;
}

namespace touchdown::scenarios {

/// Reads a scenario file and completes it from its robot's file, which `find_resource` finds. The
/// robot's file provides stance and balancer where the scenario does not; either may specify
/// `gains: lqr`. Forces with `forces_for_mass` are scaled to the robot's mass. The result holds
/// numbers only, so `scenario_from_yaml` reads it back without the robot.
/// `robot` is the robot as its file describes it, if it is compiled already.
/// Errors: `InputError` with file:line:column of either file.
Scenario complete_scenario(const YamlDocument& document,
                           std::shared_ptr<const models::RobotModel> robot = nullptr);

/// The keys of a YAML file about a robot, those that its balancer reads included.
std::vector<Key> robot_keys();

/// The number under a dotted key of a scenario, with list items by index:
/// `terrain.pieces.1.stairs.rise`. NaN if there is no such number.
double number_at(const Scenario& scenario, const std::string& key);

/// The scenario with another number under that key. Errors: `InputError` for an unknown key or a
/// number out of range, reported for a scenario file called `name`.
Scenario varied(const Scenario& scenario, const std::string& key, double value,
                const std::string& name);

}  // namespace touchdown::scenarios
