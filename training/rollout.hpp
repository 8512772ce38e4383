#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "scenarios/scenario.hpp"
#include "training/training_config.hpp"

namespace touchdown {

/// Labelled episodes of many environments side by side, ready for the network: step by step, then
/// environment by environment.
struct EpisodeBatch {
  int steps = 0;
  int environments = 0;
  int sequence = 1;
  std::vector<float> input;     ///< steps × environments × neural_input_count, not standardised
  std::vector<float> contact;   ///< steps × environments: 1 in contact, 0 not
  std::vector<float> velocity;  ///< steps × environments × 3: of the IMU in the base frame (m/s)
  /// (steps / sequence) × environments: 0 where a sequence begins a run, so that what the network
  /// remembers of the run before is void; 1 elsewhere.
  std::vector<float> keep;

  /// What the robot lived through in it (s).
  double seconds(double period) const { return period * steps * environments; }
};

/// Called after each run; returning false ends the rollout with `Stopped`.
using RolloutProgress = std::function<bool()>;

/// Plays the scenario, perturbed anew for every run, and cuts what happened into episodes: each run
/// gives `episodes_per_run` environments an episode, one after the other. If the robot falls, the
/// rest comes from another run, from the next sequence on. What happens in run n depends on (seed,
/// n) and nothing else, so that neither threads nor other runs matter.
/// Errors: `InputError` for a scenario in which the robot falls over and over again; `Stopped`.
EpisodeBatch roll_out(const RolloutConfig& config, const Scenario& scenario, std::uint64_t seed,
                      std::int64_t first_run, int environments, const RolloutProgress& progress);

/// As many episodes as fit into the scenario's duration, at least one.
int episodes_per_run(const RolloutConfig& config, const Scenario& scenario);

/// Runs that `environments` episodes come from.
int runs_for(const RolloutConfig& config, const Scenario& scenario, int environments);

/// Runs of the validation set are numbered from here.
inline constexpr std::int64_t first_validation_run = std::int64_t{1} << 40;

/// The scenario that a rollout plays: found, read, and set to the rollout's control step.
Scenario rollout_scenario(const RolloutConfig& config);

}  // namespace touchdown
