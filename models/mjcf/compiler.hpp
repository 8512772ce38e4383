#pragma once

#include <string>

#include "models/mjcf/document.hpp"
#include "models/mjcf/types.hpp"

namespace touchdown::models {

/// Compiles a robot's file with its edits, and `more` before its end, as if the text were a file
/// beside it: meshes are found, and lines keep their numbers. Errors: `InputError` with the place
/// that MuJoCo names.
///
/// From the first call on, MuJoCo's fatal errors are thrown as `Error` in the whole process, and
/// its warnings are dropped. MuJoCo's own handlers wait for a key press and write files.
MjModelPtr compile_xml(const MjcfDocument& document, const std::string& more);

/// Compiles a URDF by MuJoCo's reader and returns it as MJCF. Errors: as above.
std::string converted_to_mjcf(const MjcfDocument& urdf);

}  // namespace touchdown::models
