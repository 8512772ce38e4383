#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "models/mjcf/document.hpp"

namespace touchdown::models {

/// Reduces an MJCF to its robot. Solver options, sizes, cameras, sensors, keyframes, contact pairs
/// and a floor are removed: the scene has its own, or does without. Returns one sentence for each
/// kind of thing that was removed, with its place.
/// Errors: `InputError` with file:line:1 for everything that changes the physics and that not every
/// engine is given: other gravity, air, disabled contacts, tendons, equality constraints, obstacles
/// and other bodies, composite bodies, a floor of heights, or more than 5,000 geoms.
std::vector<std::string> keep_robot_only(MjcfDocument& document);

/// Removes what cannot be drawn because its file is missing: meshes of geoms that touch nothing,
/// and textures. Returns one sentence for each, with its place. Files are searched as MuJoCo does:
/// in `meshdir` or `texturedir`, beside the robot's file. Errors: `InputError` for a missing mesh
/// of a collider, or of a body that has its mass from it.
std::vector<std::string> drop_missing_assets(MjcfDocument& document);

/// What is wrong with a mesh that MuJoCo would read beyond its end: a face of an OBJ that counts
/// more vertices, normals or texture points than there are. With the file's line; empty if all is
/// well.
std::string fault_of_mesh(const std::filesystem::path& file);

/// The file that the address of a URDF's mesh means. A package is a folder of this name, or any
/// folder, above the URDF; MuJoCo itself searches beside the URDF. Empty if there is no such file.
std::filesystem::path urdf_asset(std::string_view address, const std::filesystem::path& urdf);

/// The files that are opened for an MJCF or a URDF: itself, what it includes, and its meshes and
/// textures as far as they exist. Errors: those of `MjcfDocument::load`.
std::vector<std::filesystem::path> opened_files(const std::filesystem::path& file);

/// A URDF as MJCF, with a free joint on its base link.
struct ConvertedUrdf {
  MjcfDocument mjcf;
  std::map<std::string, double> effort;  ///< by joint (N·m), where the URDF has a limit
};

/// Converts a URDF by MuJoCo's own reader, which rounds to six digits. `base` is the link that
/// floats; if empty, the first link with a mass from the root on. Links stay bodies of their names.
/// What is only drawn is left out; `package://` is searched in the folders above the URDF. Errors:
/// `InputError` for an unknown base, mimic joints, missing meshes and xacro; and those of MuJoCo.
ConvertedUrdf converted_urdf(const std::filesystem::path& file, const std::string& base);

}  // namespace touchdown::models
