#include "experiments/run_plan.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "experiments/reserved_seeds.hpp"
#include "experiments/resources.hpp"
#include "experiments/stopped.hpp"
#include "recordings/recording_file.hpp"
#include "scenarios/engine.hpp"

namespace touchdown {

namespace {

const Scenario& scenario_called(const std::string& file,
                                const std::vector<NamedScenario>& scenarios) {
  return std::find_if(scenarios.begin(), scenarios.end(),
                      [&](const NamedScenario& named) { return named.file == file; })
      ->scenario;
}

RunReport report(const Recording& recording, const HeardRun& heard, const ScoringConfig& scoring) {
  const auto shortest =
      static_cast<std::size_t>(std::llround(scoring.minimum_flight / recording.period()));
  const std::vector<Flight> all = flights(any_wheel(heard.contact));
  return {recording.info.outcome.value_or(Outcome::finished),
          static_cast<double>(recording.steps()) * recording.period(),
          static_cast<int>(std::count_if(all.begin(), all.end(), [&](const Flight& flight) {
            return flight.landing - flight.takeoff >= shortest;
          }))};
}

/// Nothing is fitted to runs of reserved seeds.
std::uint64_t seed_of(const Experiment& experiment, RunRole role) {
  return role == RunRole::fit ? fit_seed(experiment.seed) : experiment.seed;
}

Recording play_or_read(const Experiment& experiment, const PlannedRun& run,
                       const std::filesystem::path& file) {
  if (std::filesystem::exists(file)) return read_recording(file);
  Recording recording = play(run.scenario, run.simulator, seed_of(experiment, run.role), run.run);
  write_recording(recording, file);
  return recording;
}

}  // namespace

std::vector<NamedScenario> load_scenarios(const Experiment& experiment) {
  std::vector<NamedScenario> scenarios;
  for (const RunsConfig* runs : {&experiment.fit, &experiment.test}) {
    for (const std::string& file : runs->scenarios) {
      const bool known =
          std::any_of(scenarios.begin(), scenarios.end(),
                      [&](const NamedScenario& named) { return named.file == file; });
      if (known) continue;
      Scenario scenario = load_scenario(find_resource(file));
      scenario.robot = find_resource(scenario.robot);
      scenarios.push_back({file, std::move(scenario)});
    }
  }
  return scenarios;
}

std::vector<PlannedRun> plan_runs(const Experiment& experiment,
                                  const std::vector<NamedScenario>& scenarios) {
  std::vector<PlannedRun> plan;
  for (const RunRole role : {RunRole::fit, RunRole::test}) {
    const RunsConfig& runs = role == RunRole::fit ? experiment.fit : experiment.test;
    for (const std::string& simulator : experiment.simulators) {
      std::int64_t index = role == RunRole::fit ? first_fit_run : 0;
      for (const std::string& file : runs.scenarios) {
        const Scenario& scenario = scenario_called(file, scenarios);
        for (int i = 0; i < runs.runs; ++i, ++index) {
          plan.push_back(
              {role, simulator,
               runs.perturbed ? perturbed(scenario, seed_of(experiment, role), index) : scenario,
               index,
               fmt::format("{}_{}_{}_{:03}.mpack", simulator, scenario.name,
                           role == RunRole::fit ? "fit" : "test",
                           role == RunRole::fit ? index - first_fit_run : index)});
        }
      }
    }
  }
  return plan;
}

std::vector<PlayedRun> play_runs(const Experiment& experiment, const std::vector<PlannedRun>& plan,
                                 const RunDirectory& directory,
                                 const std::function<bool()>& progress) {
  std::vector<PlayedRun> played(plan.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, plan.size(), 1), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const Recording recording =
          play_or_read(experiment, plan[i], directory.file("recordings", plan[i].file));
      HeardRun heard =
          hear(recording, experiment.labels, experiment.scoring, experiment.intervals.over);
      const RunReport how = report(recording, heard, experiment.scoring);
      played[i] = {plan[i], how, std::move(heard)};
      if (!progress()) throw Stopped();
    }
  });
  return played;
}

}  // namespace touchdown
