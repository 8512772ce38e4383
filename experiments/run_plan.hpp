#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "experiments/experiment.hpp"
#include "experiments/heard_run.hpp"
#include "experiments/run_directory.hpp"
#include "scenarios/scenario.hpp"

namespace touchdown {

/// What a run is for.
enum class RunRole : int { fit, test };

/// One run that an experiment asks for.
struct PlannedRun {
  RunRole role = RunRole::test;
  std::string simulator;
  Scenario scenario;     ///< as it will be played: perturbations drawn
  std::int64_t run = 0;  ///< its index, different for every run of one engine
  std::string file;      ///< name of its recording
};

/// The experiment's scenario files, found and read, in the order of first use.
struct NamedScenario {
  std::string file;  ///< as the experiment names it
  Scenario scenario;
};
std::vector<NamedScenario> load_scenarios(const Experiment& experiment);

/// Every run of the experiment: by role (fit first), engine, scenario, index.
std::vector<PlannedRun> plan_runs(const Experiment& experiment,
                                  const std::vector<NamedScenario>& scenarios);

/// How a planned run went.
struct RunReport {
  Outcome outcome = Outcome::finished;
  double duration = 0.0;   ///< s
  int flights = 0;         ///< with both wheels off the ground, as long as scoring asks for
  std::string error = {};  ///< why there is no recording at all; its outcome is then `diverged`
};

struct PlayedRun {
  PlannedRun plan;
  RunReport report;
  HeardRun heard;
};

/// Whether a run that ended so is of no use to a study.
inline bool is_failure(Outcome outcome) {
  return outcome == Outcome::fell || outcome == Outcome::diverged;
}

/// What happens to runs whose recording is not there.
enum class MissingRun : int { simulate, refuse };

/// Simulates the planned runs in parallel and writes their recordings, or reads the recordings that
/// are there already: those that this build made of the same scenario, seed and run, and that are
/// whole. A run that cannot be simulated is a failed run and does not stop the others.
/// `progress` is called after each run, `going_on` now and then; returning false ends it with
/// `Stopped`. Errors: `InputError` for a scene that makes no sense; `Error` for a missing recording
/// that is not to be simulated.
std::vector<PlayedRun> play_runs(const Experiment& experiment, const std::vector<PlannedRun>& plan,
                                 const RunDirectory& directory,
                                 const std::function<bool()>& progress,
                                 const std::function<bool()>& going_on = {},
                                 MissingRun missing = MissingRun::simulate);

/// Whether `play_runs` would find the run's recording, or the reason why it has none.
bool is_recorded(const Experiment& experiment, const PlannedRun& run,
                 const RunDirectory& directory);

/// Whether the run's recording was finished, without reading it.
bool has_stamp(const Experiment& experiment, const PlannedRun& run, const RunDirectory& directory);

}  // namespace touchdown
