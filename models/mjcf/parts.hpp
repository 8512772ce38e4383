#pragma once

#include <map>
#include <string>

#include "models/mjcf/document.hpp"
#include "models/robot_description.hpp"

namespace touchdown::models {

/// Gives the parts of an MJCF the names of the contract, as the robot's YAML file names them. Held
/// joints are removed: their bodies are fixed at the pose of the MJCF. A servo's joint without a
/// motor gets one, with the effort of the URDF or the description's `maximum_torque`.
/// Errors: `InputError` for a name that the MJCF does not have.
void name_parts(MjcfDocument& document, const RobotDescription& description,
                const std::map<std::string, double>& effort);

/// Exchanges the names of the left and the right leg.
void swap_sides(MjcfDocument& document);

/// The name of a servo in messages: that of the robot's own joint.
std::string own_name(const PartNames& parts, std::size_t servo);

}  // namespace touchdown::models
