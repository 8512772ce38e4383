#include "experiments/run_directory/own_files.hpp"

#include <algorithm>
#include <array>
#include <sstream>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/fingerprint.hpp"
#include "core/yaml.hpp"
#include "experiments/run_directory/lock.hpp"

namespace touchdown::experiments {

namespace fs = std::filesystem;

namespace {

/// The files and folders of its directory that a run writes to.
constexpr std::array run_files = {"config.yaml", "manifest.json", "report.html"};
constexpr std::array run_folders = {"state",   "recordings", "models",       "tables",
                                    "figures", "videos",     "trajectories", "checkpoints"};

std::string name_in(const fs::path& config) {
  try {
    const auto name = YamlDocument::load(config).root()["name"].as<std::string>("");
    return is_name_word(name) ? name : std::string();
  } catch (const std::exception&) {
    return {};
  }
}

/// The request by the manifest, for a finished run after its `state` was removed; empty if there is
/// none.
std::string finished_request_in(const fs::path& directory) {
  try {
    // JSON is a subset of YAML.
    const YAML::Node manifest = YamlDocument::load(directory / "manifest.json").root();
    return manifest["versions"]["touchdown"] ? manifest["id"].as<std::string>() : std::string();
  } catch (const std::exception&) {
    return {};
  }
}

/// A run writes its key first. If there is a key by now, `file` may belong to a run that starts at
/// the same time.
void refuse_unless_owned(const fs::path& directory, const fs::path& file) {
  std::error_code ignored;
  if (!fs::exists(fs::symlink_status(file, ignored)) || owner_of(directory)) return;
  throw InputError(
      fmt::format("{}: {} is there already, and no run of touchdown made it: choose another --out",
                  directory.string(), file.lexically_relative(directory).string()));
}

/// The journal of a run directory: a line for each file that a run writes there.
constexpr const char* journal_name = "state/files";

/// Several processes may append at once, and each may be killed. Only whole lines match their
/// checksum, not cut or mixed ones; a cut line ends where the next one begins.
std::string line_of(const std::string& name) {
  return fmt::format("\n{} {}\n", Fingerprint().add(name).text(), name);
}

/// Errors: `InputError` for a directory of an earlier version, which had a folder in its place.
fs::path journal_of(const fs::path& directory) {
  if (!is_folder(directory / journal_name)) return directory / journal_name;
  throw InputError(fmt::format(
      "{}: holds a run of an earlier touchdown, whose files this one cannot tell from yours: "
      "remove the directory, or choose another --out",
      directory.string()));
}

/// The link through which a run's file would be reached; empty if there is none.
fs::path link_above(const fs::path& directory, const fs::path& name) {
  std::error_code ignored;
  fs::path above = directory;
  for (const fs::path& folder : name.parent_path()) {
    if (fs::is_symlink(above /= folder, ignored)) return above;
  }
  return {};
}

void require_no_link(const fs::path& directory, const fs::path& name) {
  const fs::path link = link_above(directory, name);
  if (link.empty()) return;
  throw InputError(fmt::format(
      "{}: is a link, where a run makes a folder of its own: remove the link, or choose another "
      "--out",
      link.string()));
}

bool is_regular(const fs::path& directory, const fs::path& name) {
  std::error_code ignored;
  return link_above(directory, name).empty() &&
         fs::symlink_status(directory / name, ignored).type() == fs::file_type::regular;
}

/// The folders that a run creates, inner folders first.
std::vector<fs::path> folders_of(const fs::path& directory) {
  std::vector<fs::path> folders;
  std::error_code ignored;
  for (const fs::path& entry : entries_in(directory / "state")) {
    if (fs::symlink_status(entry, ignored).type() != fs::file_type::regular) {
      folders.push_back("state" / entry.filename());
    }
  }
  folders.insert(folders.end(), run_folders.begin(), run_folders.end());
  return folders;
}

void remove_file(const fs::path& path) {
  std::error_code error;
  fs::remove(path, error);
  if (error) throw Error(fmt::format("{}: cannot be removed: {}", path.string(), error.message()));
}

void remove_empty_folders(const fs::path& directory) {
  std::error_code not_empty;
  for (const fs::path& folder : folders_of(directory)) {
    if (link_above(directory, folder / "file").empty()) fs::remove(directory / folder, not_empty);
  }
}

}  // namespace

fs::path key_file(const fs::path& directory) { return directory / "state" / "key"; }

std::string key_of(const std::string& request, const std::string& build) {
  return fmt::format("experiment {} build {}", request, build);
}

std::optional<RunDirectoryOwner> owner_of(const fs::path& directory) {
  RunDirectoryOwner owner;
  std::error_code ignored;
  if (fs::is_regular_file(key_file(directory), ignored)) {
    std::istringstream file(read_file(key_file(directory)));
    std::getline(file, owner.key);
    std::string word;
    std::string build;
    std::istringstream(owner.key) >> word >> owner.request >> word >> build;
    if (owner.key != key_of(owner.request, build)) return std::nullopt;
  } else {
    owner.request = finished_request_in(directory);
    if (owner.request.empty()) return std::nullopt;
  }
  owner.name = name_in(directory / "config.yaml");
  return owner;
}

void require_place_beside(const fs::path& directory, const std::string& config,
                          const fs::path& result) {
  if (const std::optional<RunDirectoryOwner> owner = owner_of(directory)) {
    throw InputError(fmt::format("{}: holds experiment '{}' (request {}): choose another --out",
                                 directory.string(), owner->name, owner->request));
  }
  std::error_code ignored;
  const fs::path there = directory / "config.yaml";
  if (fs::exists(directory / result, ignored) || !fs::exists(there, ignored)) return;
  if (read_file(there) != config) refuse_unless_owned(directory, there);
}

void require_no_untracked_files(const fs::path& directory) {
  for (const char* const name : run_files) refuse_unless_owned(directory, directory / name);
  for (const char* const name : run_folders) {
    const fs::path folder = directory / name;
    if (!is_folder(folder)) refuse_unless_owned(directory, folder);
    for (const fs::path& entry : entries_in(folder)) {
      // What a killed start or a concurrent one leaves there.
      if (entry == lock_file(directory) || is_part_file_name(entry.filename())) continue;
      refuse_unless_owned(directory, entry);
    }
  }
}

fs::path record_file(const fs::path& run_directory, const fs::path& name) {
  require_no_link(run_directory, name);
  append_to_file(journal_of(run_directory), line_of(name.generic_string()));
  return run_directory / name;
}

std::vector<fs::path> own_files(const fs::path& directory) {
  const fs::path journal = journal_of(directory);
  if (!is_regular(directory, journal_name)) return {};
  std::set<fs::path> names;
  std::istringstream lines(read_file(journal));
  for (std::string line; std::getline(lines, line);) {
    const std::string name = line.substr(std::min<std::size_t>(line.size(), 17));
    const fs::path path = fs::path(name).lexically_normal();
    const bool is_inside =
        line_of(name) == "\n" + line + "\n" && path.is_relative() && *path.begin() != "..";
    if (is_inside && is_regular(directory, path)) names.insert(path);
  }
  // The experiment names the directory, and the journal the files that a killed removal left.
  const bool is_named = names.erase("config.yaml") > 0;
  std::vector<fs::path> files(names.begin(), names.end());
  if (is_named) files.emplace_back("config.yaml");
  files.emplace_back(journal_name);
  return files;
}

void require_no_links(const fs::path& directory) {
  (void)journal_of(directory);
  for (const fs::path& folder : folders_of(directory)) require_no_link(directory, folder / "file");
}

void remove_own_files(const fs::path& directory) {
  for (const fs::path& name : own_files(directory)) remove_file(directory / name);
  remove_empty_folders(directory);
}

void remove_partial_files(const fs::path& directory) {
  const auto remove_from = [&](const fs::path& folder, const std::string& shape) {
    std::error_code ignored;
    for (const fs::path& entry : entries_in(directory / folder)) {
      const fs::path name = entry.filename();
      const fs::file_type type = fs::symlink_status(entry, ignored).type();
      const bool is_partial = type == fs::file_type::regular     ? is_part_file_name(name)
                              : type == fs::file_type::directory ? is_part_folder_name(name)
                                                                 : false;
      if (is_partial && has_shape(name, shape)) fs::remove_all(entry, ignored);
    }
  };
  for (const fs::path& folder : folders_of(directory)) {
    if (link_above(directory, folder / "file").empty()) remove_from(folder, ".*");
  }
  // The run directory itself, where others may have such files, too.
  remove_from({}, R"(\.(config\..*\.yaml|manifest\..*\.json|report\..*\.html))");
}

}  // namespace touchdown::experiments
