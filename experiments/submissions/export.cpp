#include "experiments/submissions/export.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <mutex>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/resources.hpp"
#include "core/table.hpp"
#include "experiments/config/experiment_yaml.hpp"
#include "experiments/config/yaml_kind.hpp"
#include "experiments/results/scores.hpp"
#include "experiments/run_directory/directory.hpp"

namespace touchdown::experiments {

namespace {

namespace fs = std::filesystem;

/// A folder for the export. A new folder is removed again unless the export is complete.
class ExportFolder {
 public:
  explicit ExportFolder(const fs::path& folder) : path_(absolute_path(folder)) {
    is_new_ = !is_there(path_);
    if (!is_new_ && !is_folder(path_)) {
      throw InputError(
          fmt::format("{}: is no folder: name a new or an empty one", folder.string()));
    }
    if (const std::vector<fs::path> content = entries_in(path_); !content.empty()) {
      throw InputError(fmt::format("{}: holds '{}': name a new or an empty folder", folder.string(),
                                   content.front().filename().string()));
    }
  }
  ~ExportFolder() {
    std::error_code not_empty;
    if (is_new_) fs::remove(path_, not_empty);
  }
  ExportFolder(const ExportFolder&) = delete;
  ExportFolder& operator=(const ExportFolder&) = delete;

  const fs::path& path() const { return path_; }

  /// Moves all content of `made` into this folder, the checksums last.
  void take(const fs::path& made) const {
    std::vector<fs::path> names;
    for (const fs::path& entry : entries_in(made)) names.push_back(entry.filename());
    std::stable_partition(names.begin(), names.end(),
                          [](const fs::path& name) { return name != "SHA256SUMS"; });
    for (const fs::path& name : names) {
      std::error_code error;
      fs::rename(made / name, path_ / name, error);
      if (!error) continue;
      throw Error(
          fmt::format("{}: cannot be written: {}", (path_ / name).string(), error.message()));
    }
  }

 private:
  fs::path path_;
  bool is_new_ = false;
};

/// The checksum and size of a written file.
struct Written {
  std::string sha256;
  std::uintmax_t bytes = 0;
  std::size_t steps = 0;  ///< 0: the run failed
};

Written write_file(const fs::path& path, const std::string& content) {
  write_atomically(path, content);
  return {sha256(content), content.size()};
}

Written write_run(const ExportedRun& exported, const RunRequest& request, const Plan& plan,
                  const RunSignals& run, const fs::path& folder) {
  ModelArrays arrays;
  if (exported.task) {
    const NoiseRun noise = noise_run(run, plan.tasks[*exported.task].noise);
    arrays = exported_arrays(run, noise, request.experiment.highlights[exported.cell].levels());
  } else {
    arrays = exported_arrays(run);
  }
  const fs::path path = folder / (exported.name + ".npz");
  Written written = write_file(path, to_npz(arrays, path.string(), Deflated::all));
  written.steps = run.steps();
  return written;
}

/// `index.csv`: a line per file of the export.
Table index_of(const std::vector<ExportedRun>& runs, const std::vector<Written>& written,
               const RunRequest& request, const Plan& plan) {
  std::vector<std::size_t> files;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (written[i].steps > 0) files.push_back(i);
  }
  const auto run = [&](std::size_t i) -> const PlannedRun& { return plan.runs[runs[i].run]; };
  const auto number = [&](std::size_t i) {
    return run(i).role == RunRole::fit ? run(i).run - first_fit_run : run(i).run;
  };
  const auto seed = [&](std::size_t i) {
    return runs[i].task ? std::to_string(plan.tasks[*runs[i].task].seed) : "";
  };
  const auto noise = [&](std::size_t i) {
    return runs[i].task ? request.experiment.highlights[runs[i].cell] : noise::NoiseCell();
  };
  return Columns<std::size_t>()
      .text("file", [&](std::size_t i) { return runs[i].name + ".npz"; })
      .text("robot", [&](std::size_t i) { return runs[i].robot; })
      .text("sensors", [&](std::size_t i) { return runs[i].sensors; })
      .text("simulator", [&](std::size_t i) { return run(i).simulator; })
      .text("role", [&](std::size_t i) { return to_text(run(i).role); })
      .text("scene", [&](std::size_t i) { return runs[i].scene; })
      .number("run", number)
      .text("noise",
            [&](std::size_t i) { return runs[i].task ? std::to_string(runs[i].cell) : ""; })
      .text("seed", seed)
      .part(noise, noise_columns())
      .count("steps", [&](std::size_t i) { return written[i].steps; })
      .level("control_period_s",
             [&](std::size_t i) {
               return 1e-6 * static_cast<double>(run(i).scenario.simulation.steps.control_us);
             })
      .table(files);
}

/// Upper bound of the size of these runs on disk (bytes).
double bytes_at_most(const std::vector<ExportedRun>& runs, const Plan& plan) {
  double bytes = 0.0;
  for (const ExportedRun& exported : runs) {
    const scenarios::Scenario& scenario = plan.runs[exported.run].scenario;
    bytes += bytes_of_exported(scenario.end.duration /
                               (1e-6 * static_cast<double>(scenario.simulation.steps.control_us)));
  }
  return bytes;
}

/// An export is whole or not at all. Errors: `Error` when its disk has fewer free bytes.
void require_free_space(const fs::path& folder, double needed, std::size_t files) {
  std::error_code unknown;
  const auto free = static_cast<double>(fs::space(folder, unknown).available);
  if (unknown || free >= needed) return;
  throw Error(fmt::format(
      "{}: this export may need {:.1f} GB ({} files), and {:.1f} GB are free: free some, choose a "
      "part (--robot, --sensors, --simulator; --dry-run lists their sizes), or name another folder",
      folder.string(), 1e-9 * needed, files, 1e-9 * free));
}

/// Writes the files of these runs. Recordings are read from `directory`; missing ones are
/// simulated.
ExportReport export_runs(const RunRequest& request, const Plan& plan,
                         const std::vector<ExportedRun>& runs, const RunDirectory& directory,
                         const fs::path& folder, const ShouldContinue& should_continue) {
  const ExportFolder place(folder);
  const PartFolder part(place.path() / "export");
  require_free_space(part.path(), bytes_at_most(runs, plan), runs.size());
  std::map<std::size_t, std::vector<std::size_t>> exported_by_run;
  std::set<std::size_t> needed;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    exported_by_run[runs[i].run].push_back(i);
    needed.insert(runs[i].run);
  }
  std::vector<Written> written(runs.size());  // each by one thread
  std::mutex mutex;
  std::map<std::string, std::string> failed;  // endings by file
  for_each_rollout("simulating", request.experiment, plan, needed, directory, MissingRun::refuse,
                   should_continue, [&](std::size_t index, const Rollout& run) {
                     if (run.failed()) {
                       const std::scoped_lock lock(mutex);
                       failed[run.plan.file] = run.report.ending;
                       return;
                     }
                     for (const std::size_t i : exported_by_run.at(index)) {
                       if (!should_continue()) throw Stopped();
                       written[i] = write_run(runs[i], request, plan, run.signals, part.path());
                     }
                   });
  ExportReport report;
  for (const auto& [file, ending] : failed) report.failed.push_back(file);
  std::map<std::string, std::string> sums;  // by file
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (written[i].steps == 0) continue;
    sums[runs[i].name + ".npz"] = written[i].sha256;
    ++report.files;
    report.bytes += written[i].bytes;
  }
  if (report.files == 0) {
    throw Error("no run stayed upright: there is nothing to export: " + failures_text(failed));
  }
  const std::string index = to_csv(index_of(runs, written, request, plan));
  sums["index.csv"] = write_file(part.path() / "index.csv", index).sha256;
  sums["README.md"] = write_file(part.path() / "README.md", readme_of(request)).sha256;
  std::string lines;
  for (const auto& [file, sum] : sums) lines += fmt::format("{}  {}\n", sum, file);
  write_atomically(part.path() / "SHA256SUMS", lines);
  if (!should_continue()) throw Stopped();
  place.take(part.path());
  return report;
}

RunRequest request_in(const fs::path& source) {
  std::error_code ignored;
  if (fs::is_directory(source, ignored)) return read_request(source);
  return request_of(experiment_from_yaml(
      completed(YamlDocument::load(find_resource(source)), YamlKind::experiment)));
}

}  // namespace

std::string export_outline(const ExportRequest& wanted) {
  const RunRequest request = request_in(wanted.source);
  const Plan plan = whole_plan(request);
  const std::vector<ExportedRun> runs = part_of(exported_runs(request, plan), wanted.part, plan);
  std::map<std::array<std::string, 3>, std::vector<ExportedRun>> parts;
  for (const ExportedRun& run : runs) {
    parts[{run.robot, run.sensors, plan.runs[run.run].simulator}].push_back(run);
  }
  const auto megabytes = [&](const std::vector<ExportedRun>& part_runs) {
    return fmt::format("{:.0f}", 1e-6 * bytes_at_most(part_runs, plan));
  };
  const auto test_files = [](const std::vector<ExportedRun>& part_runs) {
    return std::count_if(part_runs.begin(), part_runs.end(),
                         [](const ExportedRun& run) { return run.task; });
  };
  TextTable table{{"robot", "sensors", "simulator", "fit files", "test files", "MB at most"}, {}};
  const auto add = [&](const std::array<std::string, 3>& name,
                       const std::vector<ExportedRun>& part_runs) {
    const auto test = static_cast<std::size_t>(test_files(part_runs));
    table.rows.push_back({name[0], name[1], name[2], std::to_string(part_runs.size() - test),
                          std::to_string(test), megabytes(part_runs)});
  };
  for (const auto& [name, part_runs] : parts) add(name, part_runs);
  add({"all", "", ""}, runs);
  return to_text(table, 3);
}

ExportReport export_benchmark(const ExportRequest& wanted, const RunOptions& options) {
  RunRequest request = request_in(wanted.source);
  const auto write = [&](RunDirectory directory) {
    Plan whole = whole_plan(request);
    ExperimentContext context =
        start(std::move(request), std::move(whole), std::move(directory), options);
    Plan& plan = context.plan;
    const std::vector<ExportedRun> runs =
        part_of(exported_runs(context.request, plan), wanted.part, plan);
    for (const ExportedRun& exported : runs) {
      PlannedRun& run = plan.runs[exported.run];
      run.kept = run.kept && is_recorded(run, context.directory);
    }
    try {
      return export_runs(context.request, plan, runs, context.directory, wanted.folder,
                         context.should_continue);
    } catch (const Stopped&) {
      throw Stopped("stopped; nothing was written");
    }
  };
  const std::string name = request.experiment.name;
  const std::string id = request.id;
  std::error_code ignored;
  if (fs::is_directory(wanted.source, ignored)) {
    RunDirectory directory(name, id, wanted.source);
    directory.keep(DirectoryLock::for_reading(wanted.source, options.command));
    return write(std::move(directory));
  }
  // The export needs a directory for the state of runs that cannot be simulated.
  request.experiment.recordings = KeptRecordings::none;
  const PartFolder scratch(temporary_folder() / "touchdown_export");
  return write(RunDirectory(name, id, scratch.path()));
}

}  // namespace touchdown::experiments
