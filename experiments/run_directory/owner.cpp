#include "experiments/run_directory/owner.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/yaml.hpp"
#include "experiments/run_directory/lock.hpp"

namespace touchdown::experiments {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view before_request = "experiment ";
constexpr std::string_view before_build = " build ";

std::string name_in(const fs::path& config) {
  try {
    const auto name = YamlDocument::load(config).root()["name"].as<std::string>("");
    return is_name_word(name) ? name : std::string();
  } catch (const std::exception&) {
    return {};
  }
}

/// The owner by the manifest, for a finished run after its `state` was removed.
std::optional<RunDirectoryOwner> finished_in(const fs::path& directory) {
  try {
    // JSON is a subset of YAML.
    const YAML::Node manifest = YamlDocument::load(directory / "manifest.json").root();
    if (!manifest["versions"]["touchdown"]) return std::nullopt;
    return RunDirectoryOwner{
        {}, manifest["id"].as<std::string>(), name_in(directory / "config.yaml")};
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

/// An entry of a folder that neither a killed start nor a concurrent start leaves there.
fs::path untracked_file_in(const fs::path& folder) {
  for (const fs::path& entry : entries_in(folder)) {
    const bool is_lock = entry == lock_file(folder.parent_path());
    if (!is_lock && !is_part_file_name(entry.filename())) return entry;
  }
  return is_folder(folder) ? fs::path() : folder;
}

/// A run writes its key first. If there is a key by now, `file` may belong to a run that starts at
/// the same time.
void refuse_unless_owned(const fs::path& directory, const fs::path& file) {
  if (owner_of(directory)) return;
  throw InputError(
      fmt::format("{}: {} is there already, and no run of touchdown made it: choose another --out",
                  directory.string(), file.lexically_relative(directory).string()));
}

}  // namespace

fs::path key_file(const fs::path& directory) { return directory / "state" / "key"; }

std::string key_of(const std::string& request, const std::string& build) {
  return fmt::format("{}{}{}{}", before_request, request, before_build, build);
}

std::optional<RunDirectoryOwner> owner_of(const fs::path& directory) {
  std::error_code ignored;
  if (!fs::is_regular_file(key_file(directory), ignored)) return finished_in(directory);
  RunDirectoryOwner owner;
  owner.key = read_file(key_file(directory));
  owner.key = owner.key.substr(0, owner.key.find('\n'));
  const std::size_t build = owner.key.find(before_build);
  if (!owner.key.starts_with(before_request) || build == std::string::npos) return std::nullopt;
  owner.request = owner.key.substr(before_request.size(), build - before_request.size());
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
  std::error_code ignored;
  for (const char* const name : run_files) {
    const fs::path file = directory / name;
    if (fs::exists(fs::symlink_status(file, ignored))) refuse_unless_owned(directory, file);
  }
  for (const char* const name : run_folders) {
    const fs::path folder = directory / name;
    if (!fs::exists(fs::symlink_status(folder, ignored))) continue;
    const fs::path untracked = untracked_file_in(folder);
    if (!untracked.empty()) refuse_unless_owned(directory, untracked);
  }
}

}  // namespace touchdown::experiments
