#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/yaml.hpp"

namespace touchdown {

/// Where a file that an experiment, a scenario or a command names really is: `path` itself if it
/// exists from here, otherwise the same path in the project's sources, in its installation, or in
/// `share/touchdown` beside the program or library that asks.
/// Errors: `InputError` naming the nearest existing file, or saying that it is a folder.
std::filesystem::path find_resource(const std::filesystem::path& path);

/// Errors: `InputError` when there is no such file, with the nearest name in its folder, or when it
/// is a folder itself.
void require_file(const std::filesystem::path& path);

/// The files in `folder` with this extension, from here and from where the project's own ones are,
/// as `find_resource` takes them; sorted.
std::vector<std::filesystem::path> resources_in(const std::filesystem::path& folder,
                                                const std::string& extension);

/// Looks for every file that a document names under these dotted keys, of lists in all their items:
/// "fit.pieces.scenario". Errors: `InputError` for the first that is not there, with the place that
/// names it.
void require_resources(const YamlDocument& document, const std::vector<std::string>& keys);

}  // namespace touchdown
