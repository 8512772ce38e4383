#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/yaml.hpp"

namespace touchdown {

/// Finds a file that an experiment, a scenario or a command names. Returns `path` itself if it
/// exists. Otherwise looks for the same path in the project's sources, in its installation, and in
/// `share/touchdown` beside the running program or library.
/// Errors: `InputError` that suggests the nearest existing file, or if the path is a folder.
std::filesystem::path find_resource(const std::filesystem::path& path);

/// The same for a name that the program itself uses, not its user: its default robot, its shipped
/// models. A file of this name in the working directory does not replace the program's; it is used
/// only where the program has none.
std::filesystem::path find_program_file(const std::filesystem::path& path);

/// The folder of the sources that this program was built from, if it is still there.
std::optional<std::filesystem::path> source_folder();

/// Errors: `InputError` when the file does not exist, with the nearest name in its folder, or when
/// it is no regular file.
void require_file(const std::filesystem::path& path);

/// The files with this extension in `folder`, in all places where `find_resource` looks; sorted.
/// The paths are as `find_resource` takes them.
std::vector<std::filesystem::path> resources_in(const std::filesystem::path& folder,
                                                const std::string& extension);

/// Checks the names that a document has under these dotted keys, for example
/// "fit.segments.scenario", by `require`, which throws `InputError` for a wrong one. Keys apply to
/// all items of a list. Errors: `InputError` for the first wrong name, with its position in the
/// document.
void require_resources(const YamlDocument& document, const std::vector<std::string>& keys,
                       const std::function<void(const std::string& name)>& require);

}  // namespace touchdown
