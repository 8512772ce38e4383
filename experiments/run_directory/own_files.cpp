#include "experiments/run_directory/own_files.hpp"

#include <algorithm>
#include <set>
#include <string>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/yaml.hpp"
#include "experiments/run_directory/directory.hpp"
#include "experiments/run_directory/lock.hpp"
#include "experiments/run_directory/owner.hpp"
#include "experiments/run_directory/recorded_files.hpp"

namespace touchdown::experiments {

namespace fs = std::filesystem;

namespace {

using Names = std::vector<std::string>;

/// Files with names that do not depend on the experiment.
struct FixedNames {
  const char* folder;
  const char* shape;
};
constexpr std::array fixed_names = {FixedNames{"state", R"((scenario|sensors)_\d{3,}\.yaml)"},
                                    FixedNames{"state/evaluation", R"(.+_seed_\d{4,})"},
                                    FixedNames{"state/shards", R"(\d+_of_\d+)"},
                                    FixedNames{"state/columns", R"([a-z_]+\.csv)"},
                                    FixedNames{"state/tuning", R"(.+_fold_\d+)"},
                                    FixedNames{"state/submissions", R"([^.].*)"},
                                    FixedNames{"videos", R"(report\.(mp4|jpg))"},
                                    FixedNames{"tables", R"(training\.csv)"},
                                    FixedNames{"figures", R"(training\.(gp|png))"},
                                    FixedNames{"models", R"(nmn\.(npz|json))"},
                                    FixedNames{"checkpoints", R"(\d{4,}\.pt)"}};

/// The items of model tasks, in a folder of `state` for each kind.
constexpr const char* model_task_shape = R"([a-z]+_\d{6,})";

/// Files of earlier versions, which did not record them (`recorded_files.hpp`). The list is closed:
/// new tables and films need no line here.
constexpr std::array names_before_records = {
    FixedNames{
        "tables",
        "(agreement|benchmark|benchmark_differences|benchmark_standings|calibration|classification|"
        "density_overlap|differences|evidence|labels|"
        "latency|moments|odometry|operating_points|operating_points_by_scene|overlap|reliability|"
        "results|runs|sample_efficiency|sensitivity|sensor_sweep|success|"
        "survival|torque_densities|torque_distributions|torques|transfer|"
        "transitions|tuning|"
        "verdicts|views)\\.csv|"
        "(cross_simulator|labels|tables)\\.md|tables\\.tex|(benchmark|summary)\\.json"},
    FixedNames{"videos", R"(worst_.+\.mp4|closed_loop_.+\.(mp4|jpg))"},
    FixedNames{"trajectories", R"([^.].*\.tum)"}, FixedNames{".", R"(benchmark\.html)"}};

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

/// A list of names, or one name, under a key of a YAML file; none if the file cannot be read.
Names names_under(const char* key, const fs::path& file) {
  try {
    const YAML::Node node = YamlDocument::load(file).root()[key];
    if (node.IsScalar()) return {node.as<std::string>()};
    return node.as<Names>(Names());
  } catch (const std::exception&) {
    return {};
  }
}

/// Names of models and videos, which consist of the experiment's engines, estimators and scenarios.
std::vector<fs::path> models_and_videos(const fs::path& directory) {
  const fs::path config = directory / "config.yaml";
  std::vector<fs::path> names;
  for (const std::string& simulator : names_under("simulators", config)) {
    for (const std::string& estimator : names_under("estimators", config)) {
      names.push_back(fs::path("models") / model_name(simulator, estimator));
    }
    for (const std::string& file : files_in(directory / "state")) {
      if (!file.starts_with("scenario_")) continue;
      for (const std::string& scenario : names_under("name", directory / "state" / file)) {
        if (!is_name_word(scenario)) continue;
        names.push_back(fs::path("videos") / video_name(simulator, scenario));
      }
    }
  }
  return names;
}

/// A recording belongs to the run if it has a stamp.
std::vector<fs::path> recordings_and_stamps(const fs::path& directory) {
  std::vector<fs::path> names;
  for (const std::string& stamp : files_in(directory / "state/recordings")) {
    const fs::path recording = fs::path(stamp).stem();
    const bool is_stamp =
        fs::path(stamp).extension() == ".sum" || fs::path(stamp).extension() == ".failed";
    if (!is_stamp || recording.extension() != ".mpack") continue;
    names.push_back("recordings" / recording);
    names.push_back(fs::path("state/recordings") / stamp);
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

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return !fs::is_symlink(path.parent_path(), ignored) &&
         fs::symlink_status(path, ignored).type() == fs::file_type::regular;
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

std::vector<fs::path> own_files(const fs::path& directory) {
  std::vector<fs::path> names = models_and_videos(directory);
  append(names, recordings_and_stamps(directory));
  append(names, figures(directory));
  const auto add = [&](const fs::path& folder, const char* shape) {
    for (const std::string& file : files_in(directory / folder)) {
      if (has_shape(file, shape)) names.push_back((folder / file).lexically_normal());
    }
  };
  append(names, recorded_files(directory));
  for (const FixedNames& fixed : names_before_records) add(fixed.folder, fixed.shape);
  for (const FixedNames& fixed : fixed_names) add(fixed.folder, fixed.shape);
  for (const std::string& folder : all_folders(directory)) {
    if (folder.starts_with("state/")) add(folder, model_task_shape);
  }
  // Each record comes after its file: after a killed removal it still names it.
  add("state/files", R"([^.].*)");
  // Scenarios and the experiment come last: after a killed removal they still name the other files.
  std::stable_partition(names.begin(), names.end(), [](const fs::path& name) {
    return !name.filename().string().starts_with("scenario_");
  });
  for (const char* const file : {"report.html", "manifest.json", "config.yaml"}) {
    names.emplace_back(file);
  }
  std::erase_if(names, [&](const fs::path& name) { return !is_file(directory / name); });
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
  if (is_file(key_file(directory))) remove_file(key_file(directory));
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
  if (is_file(lock_file(directory))) remove_file(lock_file(directory));
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
    const bool is_ours =
        std::any_of(run_files.begin(), run_files.end(), [&](const fs::path& whole) {
          return file.starts_with(fmt::format(".{}.", whole.stem().string())) &&
                 file.ends_with(fmt::format(".part{}", whole.extension().string()));
        });
    if (is_ours && is_part_file_name(file)) partial.push_back(directory / file);
  }
  for (const fs::path& path : partial) fs::remove_all(path, ignored);
}

}  // namespace touchdown::experiments
