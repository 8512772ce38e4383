#include "experiments/submissions/exported_runs.hpp"

#include <algorithm>
#include <functional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"
#include "core/file_names.hpp"
#include "core/yaml.hpp"
#include "experiments/studies/benchmark/plan.hpp"

namespace touchdown::experiments {

namespace {

/// The scene's own name: on another robot, runs are named after both.
std::string scene_name(const PlannedRun& run, const RobotAndSensors& setting) {
  const std::string& name = run.scenario.name;
  if (setting.robot.empty()) return name;
  const std::string robot = std::filesystem::path(setting.robot).stem().string();
  return name.substr(0, name.size() - robot.size() - 1);
}

bool is_of(const PlannedRun& run, const BenchmarkSetup& setting) {
  if (run.role == RunRole::test) return run.group == setting.group;
  return run.fit == setting.setting.fit && run.sensors == setting.setting.sensors;
}

/// Keeps the runs whose name is among those that were asked for.
void keep(std::vector<HeardRun>& runs, const char* flag, const std::vector<std::string>& wanted,
          const std::function<std::string(const HeardRun&)>& name_of) {
  if (wanted.empty()) return;
  std::vector<std::string> known;
  for (const HeardRun& run : runs) {
    const std::string name = name_of(run);
    if (std::find(known.begin(), known.end(), name) == known.end()) known.push_back(name);
  }
  for (const std::string& name : wanted) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    throw InputError(fmt::format("{}: the benchmark has no '{}': expected one of {}{}", flag, name,
                                 fmt::join(known, ", "), did_you_mean(name, known)));
  }
  std::erase_if(runs, [&](const HeardRun& run) {
    return std::find(wanted.begin(), wanted.end(), name_of(run)) == wanted.end();
  });
}

}  // namespace

std::vector<HeardRun> exported_runs(const RunRequest& request, const Plan& plan) {
  const Experiment& experiment = request.experiment;
  if (!experiment.benchmark) {
    throw InputError(fmt::format(
        "experiment '{}' is no benchmark: expected a section 'benchmark', as in "
        "experiments/studies/benchmark.yaml ('benchmark: {{}}' takes the scenes' own robot and sensors)",
        experiment.name));
  }
  std::vector<std::vector<std::size_t>> tasks(plan.runs.size());
  for (std::size_t t = 0; t < plan.tasks.size(); ++t) tasks[plan.tasks[t].run].push_back(t);
  std::vector<HeardRun> all;
  for (const BenchmarkSetup& setting : benchmark_settings(request, plan)) {
    for (const std::string& name : {setting.robot, setting.sensors}) {
      if (is_name_word(name)) continue;
      throw InputError(fmt::format("benchmark: '{}': {}", name, expected_name_word));
    }
    for (std::size_t i = 0; i < plan.runs.size(); ++i) {
      const PlannedRun& run = plan.runs[i];
      if (!is_of(run, setting)) continue;
      const std::string stem = fmt::format("{}/{}/{}", setting.robot, setting.sensors,
                                           std::filesystem::path(run.file).stem().string());
      HeardRun heard{stem, setting.robot, setting.sensors, scene_name(run, setting.setting), i};
      if (run.role == RunRole::fit) all.push_back(heard);
      for (const std::size_t task : tasks[i]) {
        for (std::size_t cell = 0; cell < experiment.highlights.size(); ++cell) {
          heard.name = fmt::format("{}_noise_{}_seed_{}", stem, cell, plan.tasks[task].seed);
          heard.task = task;
          heard.cell = cell;
          all.push_back(heard);
        }
      }
    }
  }
  return all;
}

std::vector<HeardRun> part_of(const std::vector<HeardRun>& all, const BenchmarkPart& part,
                              const Plan& plan) {
  std::vector<HeardRun> runs = all;
  keep(runs, "--robot", part.robots, [](const HeardRun& run) { return run.robot; });
  keep(runs, "--sensors", part.sensors, [](const HeardRun& run) { return run.sensors; });
  keep(runs, "--simulator", part.simulators,
       [&](const HeardRun& run) { return plan.runs[run.run].simulator; });
  return runs;
}

}  // namespace touchdown::experiments
