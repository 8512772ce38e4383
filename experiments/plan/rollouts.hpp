#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "experiments/plan/plan.hpp"
#include "experiments/run_directory/directory.hpp"
#include "experiments/signals/run_signals.hpp"

namespace touchdown::experiments {

struct RunReport {
  logs::Outcome outcome = logs::Outcome::finished;
  double duration = 0.0;    ///< s
  int flights = 0;          ///< with both wheels off the ground for the scoring's minimum time
  int wheel_flights = 0;    ///< with one wheel off the ground, as long
  std::string error = {};   ///< why there is no recording; the outcome is then `diverged`
  std::string ending = {};  ///< outcome, time and reason (scenarios/scenario.hpp)

  static auto members(auto& report) {
    return std::tie(report.outcome, report.duration, report.flights, report.wheel_flights,
                    report.error, report.ending);
  }
};

/// Whether studies exclude runs with this outcome.
inline bool is_failure(logs::Outcome outcome) {
  return outcome == logs::Outcome::fell || outcome == logs::Outcome::diverged ||
         outcome == logs::Outcome::left_terrain;
}

/// A planned run that was simulated or read, and how it ended.
struct FinishedRun {
  PlannedRun plan;
  RunReport report;

  bool failed() const { return is_failure(report.outcome); }
};

/// By index in the plan.
using FinishedRuns = std::map<std::size_t, FinishedRun>;

/// The same with its signals, which take hundreds of kilobytes per second of the run.
struct Rollout : FinishedRun {
  RunSignals signals;
};

/// Whether any test run can be scored: did not fail.
bool is_any_scored(const FinishedRuns& runs);

/// The test run with this index on this engine, null if there is none.
const FinishedRun* test_run(const std::vector<FinishedRun>& runs, const std::string& simulator,
                            std::int64_t index);

enum class MissingRun : int { simulate, refuse };

/// Called repeatedly during long computations; false stops them with `Stopped`.
using ShouldContinue = std::function<bool()>;

/// Receives each rollout with its run's index in the plan, from several threads at once.
using UseRollout = std::function<void(std::size_t index, Rollout run)>;

/// Identifies the simulation of a run: its inputs and the build. Runs that differ only in their
/// sensor model or fit share it.
std::string simulation_key(const PlannedRun& run);

/// Simulates planned runs in parallel and writes the recordings to keep. It reads complete
/// recordings that this build made of the same scenario, seed and run. A run that keeps no
/// recording is always simulated, for either value of `missing`. `title` is for the progress. A run
/// that cannot be simulated is a failed run and does not stop the others. Errors: `InputError` for
/// an invalid scene; `Error` for a missing recording with `MissingRun::refuse`; `Stopped`; those of
/// `use`.
void for_each_rollout(const std::string& title, const Experiment& experiment, const Plan& plan,
                      const std::set<std::size_t>& needed, const RunDirectory& directory,
                      MissingRun missing, const ShouldContinue& should_continue,
                      const UseRollout& use);

/// Replaces a recording's observations by what these sensors report of them, and returns the
/// signals, without motion.
RunSignals reported_signals(const noise::SensorProfile& sensors, const Experiment& experiment,
                            const models::RobotModel& robot, logs::Recording& recording);

/// Whether the run's recording, or its failure, is saved; true for a run that keeps no recording.
bool is_recorded(const PlannedRun& run, const RunDirectory& directory);

/// Whether the run's recording was completed. Does not read the recording.
bool has_stamp(const PlannedRun& run, const RunDirectory& directory);

/// Describes runs that all failed by the first of them, for errors: "FILE fell after 0.675 s: pitch
/// beyond 1 rad, and 5 others". The argument holds their endings (`RunReport::ending`) by file.
std::string failures_text(const std::map<std::string, std::string>& ending_by_file);

/// One line for each run that cannot be scored, with the reason. Fits with other sensors share a
/// recording, which has one line.
std::string unused_runs_text(const std::vector<FinishedRun>& runs);

}  // namespace touchdown::experiments
