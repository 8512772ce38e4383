#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "apps/training/config/training.hpp"
#include "apps/training/trainer.hpp"
#include "noise/sensor_profile.hpp"
#include "scenarios/scenario.hpp"

namespace touchdown::training {

/// Called after each run; returning false ends the rollout with `Stopped`.
using RolloutProgress = std::function<bool()>;

/// Scenarios in engines, with a sensor profile.
struct RolloutScenes {
  struct Scene {
    scenarios::Scenario scenario;
    std::string simulator;
  };
  std::vector<Scene> scenes;  ///< used in turn by successive runs
  noise::SensorProfile sensors;
};

/// Simulates the scenes in turn, each run with new perturbations, and cuts the runs into episodes.
/// Each run fills one episode of `episodes_per_run` consecutive environments. If the robot falls or
/// arrives, another run provides the rest, from the next sequence on. Run n of a scene depends only
/// on (seed, n), not on threads or other runs. Errors: `InputError` for a scenario in which the
/// robot falls in every attempt; `Stopped`.
EpisodeBatch roll_out(const RolloutConfig& config, const RolloutScenes& scenes, std::uint64_t seed,
                      std::int64_t first_run, int environments, const RolloutProgress& progress);

/// Number of episodes that fit into the scenario's duration, at least one.
int episodes_per_run(const RolloutConfig& config, const scenarios::Scenario& scenario);

/// Number of runs for `environments` episodes.
int runs_for(const RolloutConfig& config, const RolloutScenes& scenes, int environments);

/// Number of the first run of the validation set.
inline constexpr std::int64_t first_validation_run = std::int64_t{1} << 40;

/// Scenes of a rollout: found, read, and set to the rollout's control step.
RolloutScenes training_scenes(const RolloutConfig& config);
RolloutScenes validation_scenes(const RolloutConfig& config);

}  // namespace touchdown::training
