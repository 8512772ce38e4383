#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "models/mjcf/document.hpp"
#include "models/robot_description.hpp"

namespace touchdown::models {

/// The keys of a robot's YAML file, for errors at their values.
class RobotKeys {
 public:
  explicit RobotKeys(std::filesystem::path file) : file_(std::move(file)) {}

  /// Throws an `InputError` at a dotted key, such as `joints.left_hip` or `held.0`.
  [[noreturn]] void fail(std::string_view key, const std::string& message) const;

 private:
  std::filesystem::path file_;
};

/// Gives the parts of an MJCF the names of the contract, as the robot's YAML file names them. Held
/// joints and their motors get the names of `held_name`. A joint without a motor gets one, with the
/// effort of the URDF or the description's `maximum_torque`.
/// Errors: `InputError` for a name that the MJCF does not have, and for parts that do not fit.
void name_parts(MjcfDocument& document, const RobotDescription& description,
                const std::map<std::string, double>& effort, const RobotKeys& keys);

/// The name of a held joint and its motor in the renamed MJCF, by its place in `PartNames::held`.
std::string held_name(std::size_t number);
/// Whether a name, which may be null, is one of these.
bool is_held_name(const char* name);

/// Exchanges the names of the left and the right leg.
void swap_sides(MjcfDocument& document);

/// The name of a servo in messages: that of the robot's own joint.
std::string own_name(const PartNames& parts, std::size_t servo);

}  // namespace touchdown::models
