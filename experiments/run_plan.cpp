#include "experiments/run_plan.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "experiments/fingerprint.hpp"
#include "experiments/manifest.hpp"
#include "experiments/reserved_seeds.hpp"
#include "experiments/resources.hpp"
#include "experiments/saved_state.hpp"
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

/// What a recording is made from, and by which build. The robot counts by its content: where its
/// file is found depends on where one stands.
std::string key_of(const Experiment& experiment, const PlannedRun& run) {
  Scenario scenario = run.scenario;
  scenario.robot.clear();
  return Fingerprint()
      .add(build_fingerprint())
      .add(to_yaml(scenario))
      .add(read_file(run.scenario.robot))
      .add(run.simulator)
      .add(fmt::format("{} {}", seed_of(experiment, run.role), run.run))
      .text();
}

/// The two files that say whether a recording can be used: its checksum, or why there is none.
std::filesystem::path stamp_of(const PlannedRun& run, const RunDirectory& directory) {
  return directory.file("state/recordings", run.file + ".sum");
}
std::filesystem::path failure_of(const PlannedRun& run, const RunDirectory& directory) {
  return directory.file("state/recordings", run.file + ".failed");
}

bool is_whole(const PlannedRun& run, const RunDirectory& directory, const std::string& key) {
  const std::optional<std::string> stamp = read_state(stamp_of(run, directory), key);
  if (!stamp) return false;
  const auto sum = file_checksum(directory.file("recordings", run.file));
  return sum && *stamp == fmt::format("{:016x}", *sum);
}

/// A run that could not be simulated.
PlayedRun failed(const PlannedRun& plan, const std::string& why) {
  PlayedRun run{plan, {.outcome = Outcome::diverged, .error = why}, {}};
  run.heard.info.simulator = plan.simulator;
  run.heard.info.run = plan.run;
  return run;
}

struct PlayRequest {
  const Experiment& experiment;
  const RunDirectory& directory;
  const std::function<bool()>& going_on;
  MissingRun missing;
};

PlayedRun heard_of(const Recording& recording, const PlannedRun& run,
                   const Experiment& experiment) {
  HeardRun heard =
      hear(recording, experiment.labels, experiment.scoring, experiment.intervals.over);
  const RunReport how = report(recording, heard, experiment.scoring);
  return {run, how, std::move(heard)};
}

PlayedRun play_or_read(const PlannedRun& run, const PlayRequest& request) {
  const auto file = request.directory.file("recordings", run.file);
  const std::string key = key_of(request.experiment, run);
  if (is_whole(run, request.directory, key)) {
    return heard_of(read_recording(file), run, request.experiment);
  }
  if (request.missing == MissingRun::refuse) {
    if (const auto why = read_state(failure_of(run, request.directory), key)) {
      return failed(run, *why);
    }
    throw Error(fmt::format("{}: is missing or not whole", file.string()));
  }
  Recording recording;
  try {
    recording = play(run.scenario, run.simulator, seed_of(request.experiment, run.role), run.run,
                     [&](double /*time*/) { return !request.going_on || request.going_on(); });
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {
    write_state(failure_of(run, request.directory), key, error.what());
    return failed(run, error.what());
  }
  if (request.going_on && !request.going_on()) throw Stopped();
  write_recording(recording, file);
  write_state(stamp_of(run, request.directory), key, fmt::format("{:016x}", *file_checksum(file)));
  return heard_of(recording, run, request.experiment);
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
                                 const std::function<bool()>& progress,
                                 const std::function<bool()>& going_on, MissingRun missing) {
  const PlayRequest request{experiment, directory, going_on, missing};
  std::vector<PlayedRun> played(plan.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, plan.size(), 1), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      played[i] = play_or_read(plan[i], request);
      if (!progress()) throw Stopped();
    }
  });
  return played;
}

bool is_recorded(const Experiment& experiment, const PlannedRun& run,
                 const RunDirectory& directory) {
  const std::string key = key_of(experiment, run);
  return is_whole(run, directory, key) || read_state(failure_of(run, directory), key).has_value();
}

bool has_stamp(const Experiment& experiment, const PlannedRun& run, const RunDirectory& directory) {
  return read_state(stamp_of(run, directory), key_of(experiment, run)).has_value();
}

}  // namespace touchdown
