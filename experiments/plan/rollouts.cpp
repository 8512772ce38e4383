#include "experiments/plan/rollouts.hpp"

#include <algorithm>
#include <cmath>
#include <new>
#include <optional>
#include <set>
#include <tuple>

#include <fmt/format.h>
#include <tbb/parallel_for_each.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/fingerprint.hpp"
#include "core/progress.hpp"
#include "experiments/plan/request.hpp"
#include "logs/log/recording_file.hpp"
#include "scenarios/engine.hpp"
#include "scenarios/leg_geometry.hpp"
#include "scenarios/scenario.hpp"

namespace touchdown::experiments {

namespace {

/// What is saved about a simulation.
struct SimulationEnd {
  std::string key;  ///< `simulation_key`
  bool is_recorded = false;
  std::uint64_t checksum = 0;  ///< of the recording, which is not used without it
  std::string error = {};      ///< why there is no recording

  static auto members(auto& end) {
    return std::tie(end.key, end.is_recorded, end.checksum, end.error);
  }
};
constexpr std::string_view simulation_parts = "recordings";

std::optional<SimulationEnd> saved_end(const PlannedRun& run, const RunDirectory& directory,
                                       const std::string& key) {
  std::optional<SimulationEnd> end =
      directory.store().find<SimulationEnd>(simulation_parts, run.file);
  if (end && end->key != key) end.reset();
  return end;
}

bool is_whole(const PlannedRun& run, const RunDirectory& directory, const std::string& key) {
  const std::optional<SimulationEnd> end = saved_end(run, directory, key);
  return end && end->is_recorded &&
         file_checksum(directory.file("recordings", run.file)) == end->checksum;
}

/// The rollout of a run that could not be simulated.
Rollout failed(const PlannedRun& plan, const std::string& why) {
  Rollout run{{plan,
               {.outcome = logs::Outcome::diverged,
                .error = why,
                .ending = "could not be simulated: " + why}},
              {}};
  run.signals.info.simulator = plan.simulator;
  run.signals.info.run = plan.run;
  return run;
}

/// The rollout of a recorded run, with the signals of its sensor model.
Rollout rollout(const PlannedRun& run, logs::Recording recording, const Plan& plan,
                const Experiment& experiment, scenarios::CompiledScenes& scenes) {
  const std::shared_ptr<const models::RobotModel> robot = scenes.as_described(run.scenario);
  RunSignals signals =
      reported_signals(plan.sensors[run.sensors].profile, experiment, *robot, recording);
  if (plan.needs_motion && run.role == RunRole::test) {
    signals.motion = std::make_shared<RunMotion>(motion_of(recording, *robot));
  }
  const auto shortest = static_cast<std::size_t>(
      std::llround(experiment.scoring.minimum_flight / recording.period()));
  const auto flights = [&](const scoring::ContactSequence& contact) {
    return static_cast<int>(scoring::flights(contact, shortest).size());
  };
  const auto& [left, right] = signals.contact;
  scoring::ContactSequence is_alike(left.size());  // both wheels in contact, or none
  std::ranges::transform(left, right, is_alike.begin(),
                         [](auto one, auto other) { return one == other ? 1 : 0; });
  return {{run,
           {recording.info.outcome.value_or(logs::Outcome::finished),
            static_cast<double>(recording.steps()) * recording.period(),
            flights(scoring::any_wheel(signals.contact)),
            flights(is_alike),
            {},
            scenarios::ending_text(recording, run.scenario.end)}},
          std::move(signals)};
}

logs::Recording simulate(const PlannedRun& run, scenarios::CompiledScenes& scenes,
                         const ShouldContinue& should_continue) {
  const auto simulator =
      scenarios::make_simulator(run.scenario, run.simulator, scenes.of(run.scenario));
  return scenarios::play(run.scenario, *simulator, run.seed, run.run,
                         [&](double /*time*/) { return should_continue(); });
}

/// The recording of a run, or the reason why there is none.
struct Recorded {
  std::optional<logs::Recording> recording;
  std::string error;
};

Recorded simulate_or_read(const PlannedRun& run, const std::string& key,
                          const RunDirectory& directory, MissingRun missing,
                          scenarios::CompiledScenes& scenes,
                          const ShouldContinue& should_continue) {
  const auto file = directory.file("recordings", run.file);
  if (is_whole(run, directory, key)) return {logs::read_recording(file), {}};
  if (missing == MissingRun::refuse) {
    const std::optional<SimulationEnd> end = saved_end(run, directory, key);
    if (end && !end->is_recorded) return {{}, end->error};
    if (run.kept) throw Error(fmt::format("{}: is missing or not whole", file.string()));
  }
  logs::Recording recording;
  try {
    recording = simulate(run, scenes, should_continue);
  } catch (const InputError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;  // no property of the run
  } catch (const std::exception& error) {
    directory.require_in_place();  // no property of the run, either
    directory.store().put(simulation_parts, run.file,
                          SimulationEnd{.key = key, .error = error.what()});
    return {{}, error.what()};
  }
  if (!should_continue()) throw Stopped();
  if (run.kept) {
    logs::write_recording(recording, directory.own_file("recordings", run.file));
    const std::optional<std::uint64_t> sum = file_checksum(file);
    if (!sum) throw Error(fmt::format("{}: cannot be read again", file.string()));
    directory.store().put(
        simulation_parts, run.file,
        SimulationEnd{.key = key, .is_recorded = true, .checksum = *sum, .error = {}});
  }
  return {std::move(recording), {}};
}

}  // namespace

std::string failures_text(const std::map<std::string, std::string>& ending_by_file) {
  if (ending_by_file.empty()) return "there is none";
  const auto& [file, ending] = *ending_by_file.begin();
  const std::size_t others = ending_by_file.size() - 1;
  const std::string more =
      others == 0 ? "" : fmt::format(", and {} other{}", others, others == 1 ? "" : "s");
  return fmt::format("{} {}{}", file, ending, more);
}

std::string unused_runs_text(const std::vector<FinishedRun>& runs) {
  std::string text;
  std::set<std::string> named;
  for (const FinishedRun& run : runs) {
    if (!run.failed() || !named.insert(run.plan.file).second) continue;
    text += fmt::format("Not used: {} ({})\n", run.plan.file, run.report.ending);
  }
  return text;
}

// The key uses the robot's content, because its path depends on the working directory.
std::string simulation_key(const PlannedRun& run) {
  scenarios::Scenario scenario = run.scenario;
  scenario.robot.clear();
  return Fingerprint()
      .add(build_fingerprint())
      .add(scenarios::to_yaml(scenario))
      .add(scenarios::robot_digest(run.scenario))
      .add(run.simulator)
      .add(fmt::format("{} {}", run.seed, run.run))
      .text();
}

bool is_any_scored(const FinishedRuns& runs) {
  return std::any_of(runs.begin(), runs.end(), [](const auto& entry) {
    return entry.second.plan.role == RunRole::test && !entry.second.failed();
  });
}

const FinishedRun* test_run(const std::vector<FinishedRun>& runs, const std::string& simulator,
                            std::int64_t index) {
  const auto found = std::find_if(runs.begin(), runs.end(), [&](const FinishedRun& run) {
    return run.plan.role == RunRole::test && run.plan.simulator == simulator &&
           run.plan.run == index;
  });
  return found == runs.end() ? nullptr : &*found;
}

RunSignals reported_signals(const noise::SensorProfile& sensors, const Experiment& experiment,
                            const models::RobotModel& robot, logs::Recording& recording) {
  report_through_sensors(sensors, experiment, recording.info.run, recording);
  RunSignals signals =
      signals_of(recording, experiment.labels, experiment.scoring, experiment.intervals.over);
  signals.legs = scenarios::leg_geometry(robot);
  return signals;
}

void for_each_rollout(const std::string& title, const Experiment& experiment, const Plan& plan,
                      const std::set<std::size_t>& needed, const RunDirectory& directory,
                      MissingRun missing, const ShouldContinue& should_continue,
                      const UseRollout& use) {
  struct Simulation {
    std::string key;
    std::vector<std::size_t> runs;  // indices in the plan
  };
  std::vector<Simulation> simulations;
  std::map<std::string, std::size_t> number;
  for (const std::size_t index : needed) {
    const auto [known, is_new] =
        number.emplace(simulation_key(plan.runs[index]), simulations.size());
    if (is_new) simulations.push_back({known->first, {}});
    simulations[known->second].runs.push_back(index);
  }
  scenarios::CompiledScenes scenes;
  Progress progress(title, "runs", static_cast<std::int64_t>(simulations.size()));
  tbb::parallel_for_each(simulations, [&](const Simulation& simulation) {
    Recorded recorded = simulate_or_read(plan.runs[simulation.runs.front()], simulation.key,
                                         directory, missing, scenes, should_continue);
    for (const std::size_t index : simulation.runs) {
      const PlannedRun& run = plan.runs[index];
      if (!recorded.recording) {
        use(index, failed(run, recorded.error));
        continue;
      }
      const bool is_last = index == simulation.runs.back();
      use(index, rollout(run, is_last ? std::move(*recorded.recording) : *recorded.recording, plan,
                         experiment, scenes));
    }
    progress.advance();
    if (!should_continue()) throw Stopped();
  });
}

bool is_recorded(const PlannedRun& run, const RunDirectory& directory) {
  if (!run.kept) return true;
  const std::string key = simulation_key(run);
  const std::optional<SimulationEnd> end = saved_end(run, directory, key);
  return end && (!end->is_recorded || is_whole(run, directory, key));
}

bool has_stamp(const PlannedRun& run, const RunDirectory& directory) {
  const std::optional<SimulationEnd> end = saved_end(run, directory, simulation_key(run));
  return end && end->is_recorded;
}

}  // namespace touchdown::experiments
