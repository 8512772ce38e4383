#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

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
/// `held_name`. A joint of an open leg without a motor gets one, without a limit. Tyres of a given
/// radius become spheres; what is named under `no_collision` touches nothing. There is a complaint
/// for each name that the MJCF does not have, and for parts that do not fit.
void name_parts(MjcfDocument& document, const PartNames& parts, FileFindings& findings,
                const RobotKeys& keys);

/// The sites of a loop's ends; empty if its <connect> has an anchor.
struct LoopSites {
  std::string first, second;
};

/// Completes the loops of closed legs: those of the YAML file become <connect>s, and their motors
/// <motor>s without a limit. Connections of sites, as MuJoCo 3 has them, become ones of bodies.
/// Returns the sites of all, in the order of the file. There is a complaint for each name that the
/// MJCF does not have.
std::vector<LoopSites> complete_loops(MjcfDocument& document, const PartNames& parts,
                                      FileFindings& findings, const RobotKeys& keys);

/// "expected a joint named 'x' in robot.xml (did you mean 'y'?)", or with the names that there are.
std::string missing(const MjcfDocument& document, std::initializer_list<std::string_view> tags,
                    const std::string& name);

/// The names of all elements with one of these tags.
std::vector<std::string> names_of(const MjcfDocument& document,
                                  std::initializer_list<std::string_view> tags);

/// The element with a name that the YAML file gives under `key`, by the first tag that has one.
/// Errors: `InputError` if there is none.
tinyxml2::XMLElement& named(const MjcfDocument& document,
                            std::initializer_list<std::string_view> tags, const std::string& name,
                            std::string_view key, const RobotKeys& keys);

/// Adds a motor to a joint that has none. Its torque limit is not in the file's motors.
tinyxml2::XMLElement& add_motor(MjcfDocument& document, const tinyxml2::XMLElement& joint);

/// The motor of a joint; null if there is none. Errors: `InputError` for several.
tinyxml2::XMLElement* only_motor_of(MjcfDocument& document, const std::string& joint);

/// The name of a held joint and its motor in the renamed MJCF, by its place in `PartNames::held`.
std::string held_name(std::size_t number);
/// Whether a name, which may be null, is one of these.
bool is_held_name(const char* name);

/// Exchanges the names of the left and the right leg.
void swap_sides(MjcfDocument& document);

/// The name of a servo in messages: that of the robot's own joint.
std::string own_name(const PartNames& parts, std::size_t servo);

}  // namespace touchdown::models
