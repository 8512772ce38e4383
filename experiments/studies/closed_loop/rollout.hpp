#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/estimators/fitted_model.hpp"
#include "experiments/plan/rollouts.hpp"
#include "experiments/studies/closed_loop/contact_source.hpp"
#include "experiments/studies/closed_loop/metrics.hpp"
#include "experiments/studies/closed_loop/plan.hpp"
#include "scenarios/engine.hpp"

namespace touchdown::experiments {

/// A closed-loop run.
struct ClosedLoopRun {
  scenarios::Scenario scenario;  ///< as simulated
  recordings::Recording recording;
  ContactTrace trace;  ///< before the policy's delay
};

/// Simulates a run of a cell. Its perturbations are those of the test run with this index, for
/// every contact source. Errors: `InputError` for an invalid scene.
ClosedLoopRun run_closed_loop(const RunRequest& request, const ClosedLoopCell& cell,
                              std::int64_t run, const FittedModels& models,
                              scenarios::CompiledScenes& scenes,
                              const ShouldContinue& should_continue);

/// Simulates one run of the section, by its number, and measures it. A run that cannot be simulated
/// counts as a fall. Errors: `InputError` for an invalid scene; `Stopped`.
ClosedLoopMetrics measure_closed_loop(const RunRequest& request, std::size_t run,
                                      const FittedModels& models, scenarios::CompiledScenes& scenes,
                                      const ShouldContinue& should_continue);

}  // namespace touchdown::experiments
