#include "experiments/export_benchmark.hpp"

#include <algorithm>
#include <array>
#include <map>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/resources.hpp"
#include "core/tables/table.hpp"
#include "experiments/config/yaml_kind.hpp"
#include "experiments/studies/experiment_file.hpp"

namespace touchdown::experiments {

namespace {

RunRequest request_in(const std::filesystem::path& source) {
  std::error_code ignored;
  if (std::filesystem::is_directory(source, ignored)) return read_request(source);
  const YamlDocument document = YamlDocument::load(find_resource(source));
  require_yaml_kind(document, YamlKind::experiment);
  return request_of(experiment_from_yaml(document));
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
  Table table{{"robot", "sensors", "simulator", "fit files", "test files", "MB at most"}, {}};
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
    ExperimentContext context = start(std::move(request), std::move(directory), options);
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
  if (std::filesystem::is_directory(wanted.source, ignored)) {
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
