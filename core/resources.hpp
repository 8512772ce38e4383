#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace touchdown {

/// Where a file that an experiment, a scenario or a command names really is: `path` itself if it
/// exists from here, otherwise the same path in the project's sources, in its installation, or in
/// `share/touchdown` beside the program or library that asks.
/// Errors: `InputError` naming the nearest existing file.
std::filesystem::path find_resource(const std::filesystem::path& path);

/// The files in `folder` with this extension, from here and from where the project's own ones are,
/// as `find_resource` takes them; sorted.
std::vector<std::filesystem::path> resources_in(const std::filesystem::path& folder,
                                                const std::string& extension);

}  // namespace touchdown
