#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "models/mjcf/document.hpp"

namespace touchdown::models {

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

}  // namespace touchdown::models
