#include "experiments/run_directory/own_files.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/yaml.hpp"
#include "experiments/run_directory/lock.hpp"
#include "experiments/run_directory/store.hpp"

namespace touchdown::experiments {

namespace fs = std::filesystem;

namespace {

/// The files and folders of its directory that a run writes to.
constexpr std::array run_files = {"config.yaml", "manifest.json", "report.html"};
constexpr std::array run_folders = {"state", "recordings", "models", "tables", "figures", "videos"};

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

/// Between folder and name in the name of a record.
constexpr char separator = ':';

fs::path records_in(const fs::path& run_directory) { return run_directory / "state" / "files"; }

std::string record_of(const fs::path& name) {
  std::string record = name.generic_string();
  std::replace(record.begin(), record.end(), '/', separator);
  return record;
}

fs::path name_of(std::string record) {
  const std::size_t end = record.find(separator);
  if (end != std::string::npos) record[end] = '/';
  return record;
}

/// A file that is not reached through a link.
bool is_regular(const fs::path& path) {
  std::error_code ignored;
  return !fs::is_symlink(path.parent_path(), ignored) &&
         fs::symlink_status(path, ignored).type() == fs::file_type::regular;
}

/// The recorded files that exist, relative to the run directory, sorted. Links are left out.
std::vector<fs::path> recorded_files(const fs::path& run_directory) {
  std::vector<fs::path> names;
  for (const fs::path& entry : entries_in(records_in(run_directory))) {
    const std::string record = entry.filename().string();
    const fs::path name = name_of(record);
    // Half-written records begin with a dot. No record leads out of the run directory.
    const bool is_inside = !record.starts_with('.') && !name.filename().string().starts_with('.');
    if (is_inside && is_regular(entry) && is_regular(run_directory / name)) {
      names.push_back(name);
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

using Names = std::vector<std::string>;

/// Files of a run that are neither recorded nor parts of the store, by their names.
struct FixedNames {
  const char* folder;
  const char* shape;
};
constexpr std::array fixed_names = {
    FixedNames{"state", R"((scenario|sensors)_\d{3,}\.yaml|inputs\.yaml)"},
    FixedNames{"state/shards", R"(\d+_of_\d+)"}, FixedNames{"videos", R"(report\.(mp4|jpg))"}};

/// Every folder that a run creates beside `state`.
constexpr std::array result_folders = {"recordings", "models",       "tables",      "figures",
                                       "videos",     "trajectories", "checkpoints", "logs"};

/// Every folder that a run creates, or a link in its place; inner folders first.
Names all_folders(const fs::path& directory) {
  Names folders;
  std::error_code ignored;
  for (const fs::path& entry : entries_in(directory / "state")) {
    const fs::file_type type = fs::symlink_status(entry, ignored).type();
    if (type == fs::file_type::directory || type == fs::file_type::symlink) {
      folders.push_back("state/" + entry.filename().string());
    }
  }
  folders.emplace_back("state");
  folders.insert(folders.end(), result_folders.begin(), result_folders.end());
  return folders;
}

/// The files directly in a folder; none if the folder is a link or missing.
Names files_in(const fs::path& folder) {
  Names names;
  std::error_code ignored;
  if (fs::is_symlink(folder, ignored)) return names;
  for (const fs::path& entry : entries_in(folder)) {
    if (fs::symlink_status(entry, ignored).type() == fs::file_type::regular) {
      names.push_back(entry.filename().string());
    }
  }
  return names;
}

/// The parts in `state`, and the recordings that some of them are about.
std::vector<fs::path> parts(const fs::path& directory) {
  std::vector<fs::path> names;
  for (const std::string& folder : all_folders(directory)) {
    if (!folder.starts_with("state/")) continue;
    for (const std::string& name : files_in(directory / folder)) {
      const fs::path part = fs::path(folder) / name;
      if (name.starts_with('.') || !is_part_of_a_store(directory / part)) continue;
      if (folder == "state/recordings") names.push_back(fs::path("recordings") / name);
      names.push_back(part);
    }
  }
  return names;
}

/// The first line of a figure's script names its pictures; the script names its data files.
std::vector<fs::path> figures(const fs::path& directory) {
  const fs::path folder = directory / "figures";
  const Names files = files_in(folder);
  std::vector<fs::path> names;
  for (const std::string& script : files) {
    if (!script.ends_with(".gp")) continue;
    const std::string stem = fs::path(script).stem().string();
    const std::string text = read_file(folder / script);
    if (script == "style.gp") names.push_back(fs::path("figures") / script);
    if (!text.starts_with(fmt::format("# Draws {}.png", stem))) continue;
    for (const std::string& file : files) {
      const bool is_picture =
          file == stem + ".png" || file == stem + ".svg" || file == stem + ".pdf";
      const bool is_data = file.starts_with(stem) && file.ends_with(".dat") &&
                           text.find(fmt::format("'{}'", file)) != std::string::npos;
      if (is_picture || is_data) names.push_back(fs::path("figures") / file);
    }
    names.push_back(fs::path("figures") / script);
  }
  return names;
}

void append(std::vector<fs::path>& all, const std::vector<fs::path>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

void remove_file(const fs::path& path) {
  std::error_code error;
  fs::remove(path, error);
  if (error) throw Error(fmt::format("{}: cannot be removed: {}", path.string(), error.message()));
}

void remove_empty_folders(const fs::path& directory) {
  std::error_code not_empty;
  for (const std::string& folder : all_folders(directory)) {
    const fs::path path = directory / folder;
    if (fs::symlink_status(path, not_empty).type() == fs::file_type::directory) {
      fs::remove(path, not_empty);
    }
  }
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

fs::path record_file(const fs::path& run_directory, const fs::path& name) {
  const fs::path record = records_in(run_directory) / record_of(name);
  if (!is_regular(record)) write_atomically(record, "");
  return run_directory / name;
}

std::vector<fs::path> own_files(const fs::path& directory) {
  std::vector<fs::path> names = recorded_files(directory);
  append(names, parts(directory));
  append(names, figures(directory));
  const auto add = [&](const fs::path& folder, const char* shape) {
    for (const std::string& file : files_in(directory / folder)) {
      if (has_shape(file, shape)) names.push_back((folder / file).lexically_normal());
    }
  };
  for (const FixedNames& fixed : fixed_names) add(fixed.folder, fixed.shape);
  // Each record comes after its file: after a killed removal it still names it.
  add("state/files", R"([^.].*)");
  // The experiment comes last, so that the directory can be identified after a killed removal.
  for (const char* const file : {"report.html", "manifest.json", "config.yaml"}) {
    names.emplace_back(file);
  }
  std::erase_if(names, [&](const fs::path& name) { return !is_regular(directory / name); });
  return names;
}

void require_no_links(const fs::path& directory) {
  std::error_code ignored;
  for (const std::string& folder : all_folders(directory)) {
    const fs::path path = directory / folder;
    if (!fs::is_symlink(path, ignored)) continue;
    throw InputError(
        fmt::format("{}: is a link, where a run makes a folder of its own: remove the link, or "
                    "choose another --out",
                    path.string()));
  }
}

void remove_own_files(const fs::path& directory) {
  for (const fs::path& name : own_files(directory)) remove_file(directory / name);
  remove_empty_folders(directory);
}

UntrackedFiles remove_run(const fs::path& directory) {
  remove_partial_files(directory);
  remove_own_files(directory);
  for (const std::string& file : files_in(directory / "logs")) {
    const bool is_log = has_shape(file, R"((shard|merge)_\d+(_\d+)?\.txt)");
    if (is_log) remove_file(directory / "logs" / file);
  }
  if (is_regular(key_file(directory))) remove_file(key_file(directory));
  UntrackedFiles left;
  std::error_code gone;
  for (const fs::path& entry : entries_below(directory)) {
    const fs::file_type type = fs::symlink_status(entry, gone).type();
    if (type == fs::file_type::directory || entry == lock_file(directory)) continue;
    ++left.files;
    if (type == fs::file_type::regular) left.bytes += size_of_file(entry);
  }
  if (left.files > 0) return left;
  // Other processes detect that the lock file is gone and lock a new one.
  if (is_regular(lock_file(directory))) remove_file(lock_file(directory));
  remove_empty_folders(directory);
  std::error_code not_empty;
  fs::remove(directory, not_empty);
  return left;
}

void remove_partial_files(const fs::path& directory) {
  std::error_code ignored;
  std::vector<fs::path> partial;
  for (const std::string& folder : all_folders(directory)) {
    if (fs::is_symlink(directory / folder, ignored)) continue;
    for (const fs::path& entry : entries_in(directory / folder)) {
      const fs::path name = entry.filename();
      const fs::file_type type = fs::symlink_status(entry, ignored).type();
      if ((type == fs::file_type::regular && is_part_file_name(name)) ||
          (type == fs::file_type::directory && is_part_folder_name(name))) {
        partial.push_back(entry);
      }
    }
  }
  for (const std::string& file : files_in(directory)) {
    const bool is_ours = std::ranges::any_of(run_files, [&](const fs::path& whole) {
      return file.starts_with(fmt::format(".{}.", whole.stem().string())) &&
             file.ends_with(fmt::format(".part{}", whole.extension().string()));
    });
    if (is_ours && is_part_file_name(file)) partial.push_back(directory / file);
  }
  for (const fs::path& path : partial) fs::remove_all(path, ignored);
}

}  // namespace touchdown::experiments
