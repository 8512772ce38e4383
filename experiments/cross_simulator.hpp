#pragma once

#include <string>
#include <vector>

#include "experiments/cross_simulator_agreement.hpp"
#include "experiments/cross_simulator_config.hpp"
#include "experiments/cross_simulator_sensitivity.hpp"
#include "experiments/cross_simulator_transfer.hpp"
#include "experiments/run_experiment.hpp"

namespace touchdown {

/// What the robustness check found out. The same is in the run directory's files.
struct CrossSimulatorResult {
  CrossSimulator config;
  std::string id;
  RunDirectory directory;
  std::vector<PlayedRun> runs;  ///< fitted and tested ones, without those of the sensitivity
  Agreement agreement;
  std::vector<Transfer> transfers;
  std::vector<Sensitivity> sensitivities;
  std::vector<Verdict> verdicts;
  Provenance provenance;
};

/// Simulates in both engines, compares what they did, fits in each and tests in both, varies one
/// factor at a time, and judges; writes tables. Recordings of an earlier attempt by the same
/// program are used. A verdict that fails is a result, not an error. Errors: `InputError` for a
/// wrong request; `Stopped`; `Error` when an engine gets through no test run that the other gets
/// through too.
CrossSimulatorResult run_cross_simulator(const CrossSimulator& config, const RunOptions& options);

/// The estimators whose verdict is demanded and fails.
std::vector<std::string> failed_demands(const std::vector<Verdict>& verdicts);

}  // namespace touchdown
