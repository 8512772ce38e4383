#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/yaml.hpp"

namespace touchdown {

/// The folder with the program's own models, scenarios and experiments.
struct ProgramFiles {
  std::filesystem::path folder;  ///< empty if there is none
  std::string why;               ///< it is this one: "beside the program"
};

/// The first of: the nearest folder above the running program or library that has these files,
/// itself (a checkout) or in `share/touchdown` (an installation, a Python package); the one that
/// the environment variable TOUCHDOWN names; the installation prefix and the sources that were
/// compiled in. A moved or copied checkout therefore reads its own files. Errors: `InputError` if
/// TOUCHDOWN is needed and names another folder.
ProgramFiles program_files();

/// Finds a file that an experiment, a scenario or a command names. Returns `path` itself if it
/// exists, else the same path among the program's files.
/// Errors: `InputError` that suggests the nearest existing file, or if the path is a folder.
std::filesystem::path find_resource(const std::filesystem::path& path);

/// The same for a name that the program itself uses, not its user: its default robot, its shipped
/// models. A file of this name in the working directory does not replace the program's; it is used
/// only where the program has none.
std::filesystem::path find_program_file(const std::filesystem::path& path);

/// Errors: `InputError` when the file does not exist, with the nearest name in its folder, or when
/// it is no regular file.
void require_file(const std::filesystem::path& path);

/// The files with this extension in `folder`, in all places where `find_resource` looks; sorted.
/// The paths are as `find_resource` takes them.
std::vector<std::filesystem::path> resources_in(const std::filesystem::path& folder,
                                                const std::string& extension);

/// Completes a document by the file that its key `base` names, and by that file's own base: the
/// document states only what differs (`YamlDocument::put_on`). Errors: `InputError` at the key for
/// a missing file, and for one that is based on itself.
YamlDocument with_base(YamlDocument document);

/// Checks the names that a document has under these dotted keys, for example
/// "fit.segments.scenario", by `require`, which throws `InputError` for a wrong one. Keys apply to
/// all items of a list. Errors: `InputError` for the first wrong name, with its position in the
/// document.
void require_resources(const YamlDocument& document, const std::vector<std::string>& keys,
                       const std::function<void(const std::string& name)>& require);

}  // namespace touchdown
