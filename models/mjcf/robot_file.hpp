#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "models/mjcf/document.hpp"

namespace touchdown::models {

/// The ends of a loop as far as MuJoCo 2 does not compile them: sites, or the second anchor.
struct LoopEnds {
  std::array<std::string, 2> sites;
  std::vector<double> second_anchor;
};

/// A robot's file with nothing but the robot in it, and what is found in it.
struct RobotFile {
  MjcfDocument document;
  std::vector<std::string> ignored = {};   ///< what is not simulated, one sentence each, with place
  std::vector<std::string> warnings = {};  ///< what may be a mistake, likewise
  std::vector<std::string> fixed = {};     ///< fixed joints of a URDF, which are none here
  std::map<std::string, double> effort = {};  ///< torque limits of a URDF by joint (N·m)
  std::string loops = {};                     ///< <connect>s of the YAML file, as MJCF
  std::vector<LoopEnds> ends = {};            ///< of all loops, in the order of the compiled model

  /// Writes a sentence about an element, with its place.
  void ignore(const tinyxml2::XMLElement& element, const std::string& text) {
    ignored.push_back(document.place_of(element) + ": " + text);
  }
};

/// "expected a body named 'x' in robot.xml (did you mean 'y'?)", or with the names that there are.
std::string missing(const MjcfDocument& document, const char* tag, const std::string& name);

/// Reduces an MJCF to its robot. Solver options, flags, gravity, sizes, sensors, keyframes, contact
/// pairs and what stands still beside the robot are removed: the scene has its own, or does
/// without. A robot that is fixed to the world gets a free joint. Errors: `InputError` for
/// everything that changes the physics and that not every engine is given: tendons, welds, coupled
/// joints, moving bodies beside the robot, or more than 5,000 geoms.
void keep_robot_only(RobotFile& robot);

/// Warns of bodies with masses that MuJoCo computes from their shapes at its own density.
void note_computed_masses(RobotFile& robot);

/// Drops what later versions of MuJoCo added where touchdown overrides or only draws it. Limits of
/// joints' torques and the damping of position servos become `user` data, with their default
/// classes. Errors: `InputError` for each other element and attribute that this version lacks.
void translate_later_versions(RobotFile& robot);

/// Removes meshes and textures without their files, and the geoms that need them. Files are
/// searched as MuJoCo does: in `meshdir` or `texturedir`, beside the robot's file. Bodies that have
/// no shape are drawn as rods. Errors: `InputError` for a missing mesh that a body has its mass
/// from, and for a faulty one.
void drop_missing_assets(RobotFile& robot);

/// What the names of touchdown's own elements begin with.
inline constexpr std::string_view own_prefix = "touchdown_";

/// Converts a URDF by MuJoCo's own reader, which rounds to six digits, to an MJCF with a free joint
/// on its base link. `base` is the link that floats; if empty, the first link with a mass from the
/// root on. Links stay bodies of their names. What is only drawn is left out; of the URDF's
/// <mujoco>, the compiler's masses count. `package://` is searched in the folders above the URDF. A
/// missing mesh leaves its link without this collider. Errors: `InputError` for an unknown base,
/// mimic joints, a missing mesh of a link without <inertial>, and xacro; and those of MuJoCo.
RobotFile converted_urdf(MjcfDocument urdf, const std::string& base);

}  // namespace touchdown::models
