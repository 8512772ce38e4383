#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "models/mjcf/document.hpp"
#include "models/mjcf/robot_file.hpp"
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

/// Gives the parts of an MJCF the names of the contract. The robot's YAML file names them; parts
/// that it does not name have these names already. Held joints and their motors get the names of
/// `held_name`. A joint without a motor gets one, without a limit. Tyres of a given radius become
/// spheres; what is named under `no_collision` touches nothing. There is a complaint for each name
/// that the MJCF does not have, and for parts that do not fit.
void name_parts(MjcfDocument& document, const PartNames& parts, FileFindings& findings,
                const RobotKeys& keys);

/// The name of a held joint and its motor in the renamed MJCF, by its place in `PartNames::held`.
std::string held_name(std::size_t number);
/// Whether a name, which may be null, is one of these.
bool is_held_name(const char* name);

/// Exchanges the names of the left and the right leg.
void swap_sides(MjcfDocument& document);

/// The name of a servo in messages: that of the robot's own joint.
std::string own_name(const PartNames& parts, std::size_t servo);

}  // namespace touchdown::models
