#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>

#include "models/mjcf/document.hpp"

namespace touchdown::models {

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
