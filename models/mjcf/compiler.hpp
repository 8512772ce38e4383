#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "models/mjcf/document.hpp"
#include "models/mjcf/types.hpp"

namespace touchdown::models {

/// Compiles an XML text as if it were a file beside `file`, where meshes are found. Errors:
/// `InputError` with the place of the line that MuJoCo names.
///
/// From the first call on, MuJoCo's fatal errors are thrown as `Error` in the whole process, and
/// its warnings are dropped. MuJoCo's own handlers wait for a key press and write files.
MjModelPtr compile_xml(const MjcfDocument::Text& xml, const std::filesystem::path& file);

/// Compiles a URDF by MuJoCo's reader and returns it as MJCF. Errors: as above.
std::string converted_to_mjcf(const MjcfDocument::Text& urdf, const std::filesystem::path& file);

}  // namespace touchdown::models
