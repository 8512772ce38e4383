#include "experiments/submissions/exported_runs.hpp"

#include <algorithm>
#include <functional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/rows.hpp"
#include "core/yaml.hpp"
#include "experiments/studies/benchmark.hpp"

namespace touchdown::experiments {

namespace {

/// The scene's own name. On another robot, the name of a run's scenario ends with the robot's name.
std::string scene_name(const PlannedRun& run, const RobotAndSensors& where) {
  const std::string& name = run.scenario.name;
  if (where.robot.empty()) return name;
  const std::string robot = std::filesystem::path(where.robot).stem().string();
  return name.substr(0, name.size() - robot.size() - 1);
}

bool is_of(const PlannedRun& run, const BenchmarkSetup& setup) {
  if (run.role == RunRole::test) return run.group == setup.group;
  return run.fit == setup.robot_and_sensors.fit && run.sensors == setup.robot_and_sensors.sensors;
}

/// Keeps the runs with a wanted name. Errors: `InputError` for a name that no run has.
void keep(std::vector<ExportedRun>& runs, const char* flag, const std::vector<std::string>& wanted,
          const std::function<std::string(const ExportedRun&)>& name_of) {
  if (wanted.empty()) return;
  const std::vector<std::string> known = unique(runs, name_of);
  for (const std::string& name : wanted) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    throw InputError(fmt::format("{}: the benchmark has no '{}': expected one of {}{}", flag, name,
                                 fmt::join(known, ", "), did_you_mean(name, known)));
  }
  std::erase_if(runs, [&](const ExportedRun& run) {
    return std::find(wanted.begin(), wanted.end(), name_of(run)) == wanted.end();
  });
}

}  // namespace

std::vector<ExportedRun> exported_runs(const RunRequest& request, const Plan& plan) {
  const Experiment& experiment = request.experiment;
  if (!experiment.studies.has<BenchmarkConfig>()) {
    throw InputError(fmt::format(
        "experiment '{}' is no benchmark: expected a section 'benchmark', as in "
        "experiments/benchmark.yaml ('benchmark: {{}}' takes the scenes' own robot and sensors)",
        experiment.name));
  }
  std::vector<std::vector<std::size_t>> tasks(plan.runs.size());
  for (std::size_t t = 0; t < plan.tasks.size(); ++t) tasks[plan.tasks[t].run].push_back(t);
  std::vector<ExportedRun> all;
  for (const BenchmarkSetup& setup : benchmark_setups(request, plan)) {
    for (const std::string& name : {setup.robot, setup.sensors}) {
      if (is_name_word(name)) continue;
      throw InputError(fmt::format("benchmark: '{}': {}", name, expected_name_word));
    }
    for (std::size_t i = 0; i < plan.runs.size(); ++i) {
      const PlannedRun& run = plan.runs[i];
      if (!is_of(run, setup)) continue;
      const std::string stem = fmt::format("{}/{}/{}", setup.robot, setup.sensors,
                                           std::filesystem::path(run.file).stem().string());
      ExportedRun exported{stem, setup.robot, setup.sensors,
                           scene_name(run, setup.robot_and_sensors), i};
      if (run.role == RunRole::fit) all.push_back(exported);
      for (const std::size_t task : tasks[i]) {
        for (std::size_t cell = 0; cell < experiment.highlights.size(); ++cell) {
          exported.name = fmt::format("{}_noise_{}_seed_{}", stem, cell, plan.tasks[task].seed);
          exported.task = task;
          exported.cell = cell;
          all.push_back(exported);
        }
      }
    }
  }
  return all;
}

std::vector<ExportedRun> part_of(const std::vector<ExportedRun>& all, const BenchmarkPart& part,
                                 const Plan& plan) {
  std::vector<ExportedRun> runs = all;
  keep(runs, "--robot", part.robots, [](const ExportedRun& run) { return run.robot; });
  keep(runs, "--sensors", part.sensors, [](const ExportedRun& run) { return run.sensors; });
  keep(runs, "--simulator", part.simulators,
       [&](const ExportedRun& run) { return plan.runs[run.run].simulator; });
  return runs;
}

}  // namespace touchdown::experiments
