#include "experiments/plan/plan.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>
#include <tuple>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/fingerprint.hpp"
#include "core/table.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/run_directory/directory.hpp"
#include "experiments/signals/reserved_seeds.hpp"
#include "noise/sensor_noise.hpp"
#include "scenarios/engine.hpp"
#include "scenarios/leg_geometry.hpp"
#include "scenarios/scenario_file.hpp"

namespace touchdown::experiments {

namespace {

/// The scenario with the setup's robot and change; recordings are named after all.
scenarios::Scenario scene_of(const RunRequest& request, const std::string& file,
                             const RunSetup& setup) {
  scenarios::Scenario scene = scenario_of(request, file, setup.robot).scenario;
  const auto& [key, value] = setup.change;
  if (!key.empty()) {
    scene = scenarios::varied(scene, key, value, file);
    std::string change = fmt::format("_{}_{}", key, exact(value));
    std::ranges::replace(change, '.', '_');
    scene.name += change;
  }
  if (!setup.robot.empty()) {
    scene.name += "_" + std::filesystem::path(setup.robot).stem().string();
  }
  return scene;
}

/// Digests of robots by their files: many runs have one robot, and its meshes may be large.
using RobotDigests = std::map<std::string, std::string>;

/// What is simulated, whatever the names of the scenario and of its robot's file.
std::string content_of(scenarios::Scenario scenario, RobotDigests& digests) {
  std::string& robot = digests[scenario.robot];
  if (robot.empty()) robot = scenarios::robot_digest(scenario);
  scenario.name.clear();
  scenario.robot.clear();
  return Fingerprint().add(robot).add(scenarios::to_yaml(scenario)).text();
}

/// Errors: `InputError` for a scene that is listed twice: intervals would count it as two.
void require_distinct_scenes(const RunRequest& request, RunRole role) {
  const Experiment& experiment = request.experiment;
  RobotDigests digests;
  std::map<std::string, std::string> known;
  for (const std::string& file :
       (role == RunRole::fit ? experiment.fit : experiment.test).scenarios) {
    const auto [same, is_new] =
        known.emplace(content_of(scenario_of(request, file).scenario, digests), file);
    if (is_new) continue;
    throw InputError(fmt::format(
        "{}.scenarios: '{}' and '{}' are the same scene: name it once, with more `runs`",
        to_text(role), same->second, file));
  }
}

/// Errors: `InputError` if these equal runs, of which the first was planned before, may not both
/// be.
void require_distinct(const PlannedRun& first, const PlannedRun& second, const Plan& plan,
                      const Experiment& experiment) {
  const char* const remedy =
      "let its scenario have a `perturbation` and the runs `perturbed: true`, or use another scene";
  if (first.role == second.role) {
    const bool is_counted_once =
        first.group != second.group || first.fit != second.fit || first.sensors != second.sensors;
    if (is_counted_once) return;
    throw InputError(
        fmt::format("{}: runs {} and {} in {} are the same one, and would count twice: {}",
                    to_text(first.role), first.file, second.file, first.simulator, remedy));
  }
  const PlannedRun& test = first.role == RunRole::test ? first : second;
  const PlannedRun& fit = first.role == RunRole::test ? second : first;
  const std::vector<Condition>& conditions = plan.groups[test.group].conditions;
  const bool is_of_its_models =
      std::any_of(conditions.begin(), conditions.end(), [&](const Condition& condition) {
        return condition.fit == fit.fit && condition.fit_simulator == fit.simulator &&
               estimator_entry(experiment, condition.estimator).fits();
      });
  if (!is_of_its_models) return;
  throw InputError(
      fmt::format("test: run {} is the one that models are fitted to, {}, and would be no test: {}",
                  test.file, fit.file, remedy));
}

}  // namespace

void add_measure(Measure measure, RunGroup& group) {
  const auto same = std::ranges::find(group.measures, measure.name, &Measure::name);
  if (same == group.measures.end()) group.measures.push_back(std::move(measure));
}

std::vector<std::size_t> RunGroup::tested_on(std::string_view simulator) const {
  std::vector<std::size_t> tested;
  for (std::size_t c = 0; c < conditions.size(); ++c) {
    if (conditions[c].test_simulator == simulator) tested.push_back(c);
  }
  return tested;
}

std::span<const Task> Plan::tasks_of(std::size_t run) const {
  const auto first = std::ranges::lower_bound(tasks, run, {}, &Task::run);
  return {first, std::ranges::upper_bound(tasks, run, {}, &Task::run)};
}

std::string_view to_text(RunRole role) { return role == RunRole::fit ? "fit" : "test"; }

std::uint64_t seed_of_fit(const Experiment& experiment) {
  // Nothing is fitted to runs of reserved seeds.
  return experiment.fit_seed.value_or(fit_seed(experiment.seed));
}

std::optional<std::size_t> Plan::group_called(std::string_view name) const {
  const auto group = std::ranges::find(groups, name, &RunGroup::name);
  if (group == groups.end()) return std::nullopt;
  return static_cast<std::size_t>(group - groups.begin());
}

const ModelTasks& Plan::model_tasks_called(std::string_view name) const {
  const auto found = std::ranges::find(model_tasks, name, &ModelTasks::name);
  if (found == model_tasks.end()) throw Error(fmt::format("'{}' is not in the plan", name));
  return *found;
}

std::vector<std::size_t> Plan::runs_in(std::size_t group, std::string_view simulator) const {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const bool is_wanted = simulator.empty() || runs[i].simulator == simulator;
    if (runs[i].role == RunRole::test && runs[i].group == group && is_wanted) indices.push_back(i);
  }
  return indices;
}

void plan_runs(const RunRequest& request, RunRole role, const RunSetup& setup, std::size_t group,
               Plan& plan) {
  const Experiment& experiment = request.experiment;
  const bool is_fit = role == RunRole::fit;
  const RunsConfig& runs = is_fit ? experiment.fit : experiment.test;
  const std::uint64_t seed = is_fit ? seed_of_fit(experiment) : experiment.seed;
  for (const std::string& simulator : experiment.simulators) {
    std::int64_t index = is_fit ? first_fit_run : 0;
    for (const std::string& file : runs.scenarios) {
      const scenarios::Scenario scene = scene_of(request, file, setup);
      for (int i = 0; i < runs.runs; ++i, ++index) {
        plan.runs.push_back({.role = role,
                             .simulator = simulator,
                             .scenario = runs.perturbed ? perturbed(scene, seed, index) : scene,
                             .run = index,
                             .file = recording_name(simulator, scene.name, to_text(role),
                                                    is_fit ? index - first_fit_run : index),
                             .seed = seed,
                             .group = group,
                             .sensors = setup.sensors,
                             .fit = is_fit ? setup.fit : std::string()});
      }
    }
  }
}

Plan plan_of(const RunRequest& request) {
  const Experiment& experiment = request.experiment;
  require_distinct_scenes(request, RunRole::fit);
  require_distinct_scenes(request, RunRole::test);
  Plan plan;
  plan.sensors.front().profile = profile_of(request.sensors, experiment.sensors);
  plan_runs(request, RunRole::fit, {}, 0, plan);
  plan_runs(request, RunRole::test, {}, 0, plan);
  plan.groups.push_back({"", own_engine_conditions(experiment),
                         noise::noise_cells(experiment.noise), experiment.highlights});
  plan_tasks(experiment, 0, plan);
  return plan;
}

std::size_t scene_of(const PlannedRun& run, const Experiment& experiment) {
  return static_cast<std::size_t>(run.run / experiment.test.runs);
}

std::set<std::size_t> runs_for(const Plan& plan, const TaskRange& tasks) {
  std::set<std::size_t> runs;
  std::set<std::string> fitted;  // engines
  std::set<std::string> fits = {""};
  for (std::size_t t = tasks.begin; t < tasks.end; ++t) {
    runs.insert(plan.tasks[t].run);
    const std::string& simulator = plan.runs[plan.tasks[t].run].simulator;
    for (const Condition& condition :
         tested_on(plan.group_of(plan.tasks[t]).conditions, simulator)) {
      fitted.insert(condition.fit_simulator);
      fits.insert(condition.fit);
    }
  }
  for (std::size_t i = 0; i < plan.runs.size(); ++i) {
    const PlannedRun& run = plan.runs[i];
    if (run.role != RunRole::fit) continue;
    if (fitted.contains(run.simulator) && fits.contains(run.fit)) runs.insert(i);
  }
  return runs;
}

void keep_recordings(const Experiment& experiment, Plan& plan) {
  std::set<std::int64_t> pictured = plan.pictured;
  pictured.insert(experiment.video.run);
  if (experiment.detail) pictured.insert(experiment.detail->choice.run);
  for (PlannedRun& run : plan.runs) {
    const bool is_pictured =
        run.role == RunRole::test && run.group == 0 && pictured.contains(run.run);
    run.kept = experiment.recordings == KeptRecordings::all ||
               (experiment.recordings == KeptRecordings::pictured && is_pictured);
  }
}

void plan_tasks(const Experiment& experiment, std::size_t first, Plan& plan) {
  for (std::size_t run = first; run < plan.runs.size(); ++run) {
    if (plan.runs[run].role != RunRole::test) continue;
    for (int seed = 0; seed < experiment.noise.seeds; ++seed) {
      plan.tasks.push_back({run, seed, noise_key(experiment, seed, plan.runs[run].run)});
    }
  }
}

void require_distinct_runs(const Plan& plan, const Experiment& experiment) {
  std::set<std::string_view> names;  // results are found by them
  for (const RunGroup& group : plan.groups) {
    if (names.insert(group.name).second) continue;
    throw InputError(
        fmt::format("the runs of '{}' are planned twice: expected each of them once", group.name));
  }
  RobotDigests digests;
  std::map<std::string, std::vector<const PlannedRun*>> same;
  for (const PlannedRun& run : plan.runs) {
    scenarios::Scenario scenario = run.scenario;
    scenario.perturbation = {};  // it is drawn
    const std::string key = run.simulator + content_of(std::move(scenario), digests);
    for (const PlannedRun* other : same[key]) require_distinct(*other, run, plan, experiment);
    same[key].push_back(&run);
  }
}

}  // namespace touchdown::experiments
