#pragma once

#include <string>
#include <vector>

#include "models/mjcf/document.hpp"

namespace touchdown::models {

/// Removes what cannot be drawn because its file is missing: meshes of geoms that touch nothing,
/// and textures. Returns one sentence for each, with its place. Files are searched as MuJoCo does:
/// in `meshdir` or `texturedir`, beside the robot's file. Errors: `InputError` for a missing mesh
/// of a collider, or of a body that has its mass from it.
std::vector<std::string> drop_missing_assets(MjcfDocument& document);

}  // namespace touchdown::models
