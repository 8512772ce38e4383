#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "models/mjcf/document.hpp"

namespace touchdown::models {

/// Runs a step and keeps its complaint, so that those of other steps come with it.
template <typename Step>
void collect(std::vector<std::string>& complaints, const Step& step) {
  try {
    step();
  } catch (const InputError& error) {
    complaints.emplace_back(error.what());
  }
}

/// A robot that cannot be simulated, with all reasons. The message is the first one, and how many
/// there are.
class RobotRefusal : public InputError {
 public:
  explicit RobotRefusal(const std::vector<std::string>& complaints);
  std::vector<std::string> complaints;
};

/// Throws a `RobotRefusal` if there are complaints.
void require_none(const std::vector<std::string>& complaints);

/// What is found in a robot's file.
struct FileFindings {
  std::vector<std::string> ignored;   ///< what is not simulated, one sentence each, with its place
  std::vector<std::string> warnings;  ///< what may be a mistake, likewise
  std::vector<std::string> complaints;   ///< what cannot be simulated, likewise
  std::vector<std::string> fixed;        ///< fixed joints of a URDF, which are none here
  std::map<std::string, double> effort;  ///< torque limits by joint (N·m), beside those of motors
};

/// Reduces an MJCF to its robot. Solver options, flags, gravity, sizes, sensors, keyframes, contact
/// pairs and what stands still beside the robot are removed: the scene has its own, or does
/// without. A robot that is fixed to the world gets a free joint. Complaints are about
/// everything that changes the physics and that not every engine is given: tendons, welds, coupled
/// joints, moving bodies beside the robot, composite bodies, height fields, or more than 5,000
/// geoms.
void keep_robot_only(MjcfDocument& document, FileFindings& findings);

/// Warns of bodies with masses that MuJoCo computes from their shapes at its own density.
void note_computed_masses(const MjcfDocument& document, FileFindings& findings);

/// Writes what later versions of MuJoCo added in the words of this one: the torque limits of
/// joints (in the findings), the damping of position servos, frames without a pose. What touchdown
/// overrides or only draws is removed. There is a complaint for each other element and attribute
/// that this version lacks.
void translate_later_versions(MjcfDocument& document, FileFindings& findings);

/// Removes meshes and textures without their files, and the geoms that need them. Files are
/// searched as MuJoCo does: in `meshdir` or `texturedir`, beside the robot's file. There is a
/// complaint for a missing mesh that a body has its mass from, and for a faulty one. Bodies that
/// have no shape are drawn as rods.
void drop_missing_assets(MjcfDocument& document, FileFindings& findings);

/// What is wrong with a mesh that MuJoCo would read beyond its end: a face of an OBJ that counts
/// more vertices, normals or texture points than there are. With the file's line; empty if all is
/// well.
std::string fault_of_mesh(const std::filesystem::path& file);

/// What the address of a file in a package begins with.
inline constexpr std::string_view package_address = "package://";

/// `meshdir` of an MJCF's compiler, or of MuJoCo's section of a URDF.
std::string mesh_folder(const MjcfDocument& document);

/// The file that the address of a URDF's mesh means. A package is a folder of this name, or any
/// folder, above the URDF; MuJoCo itself searches beside the URDF, or in its `mesh_folder`. Empty
/// if there is no such file.
std::filesystem::path urdf_asset(std::string_view address, const std::filesystem::path& urdf,
                                 const std::string& mesh_folder);

/// The files that are opened for an MJCF or a URDF: itself, what it includes, and its meshes and
/// textures as far as they exist. Errors: those of `MjcfDocument::load`.
std::vector<std::filesystem::path> opened_files(const std::filesystem::path& file);

/// Converts a URDF by MuJoCo's own reader, which rounds to six digits, to an MJCF with a free joint
/// on its base link. `base` is the link that floats; if empty, the first link with a mass from the
/// root on. Links stay bodies of their names. What is only drawn is left out; of the URDF's
/// <mujoco>, the compiler's masses count. `package://` is searched in the folders above the URDF. A
/// missing mesh leaves its link without this collider. Errors: `InputError` for an unknown base,
/// mimic joints, a missing mesh of a link without <inertial>, and xacro; and those of MuJoCo.
MjcfDocument converted_urdf(const std::filesystem::path& file, const std::string& base,
                            FileFindings& findings);

}  // namespace touchdown::models
