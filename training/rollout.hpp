#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "noise/sensors/profile.hpp"
#include "scenarios/scenario.hpp"
#include "training/config.hpp"

namespace touchdown::training {

/// Called after each run; returning false ends the rollout with `Stopped`.
using RolloutProgress = std::function<bool()>;

/// What is rolled out: scenarios in engines, heard through sensors.
struct RolloutScenes {
  struct Scene {
    scenarios::Scenario scenario;
    std::string simulator;
  };
  std::vector<Scene> scenes;  ///< taken in turn, run by run
  noise::SensorProfile sensors;
};

/// Plays the scenes in turn, perturbed anew for every run, and cuts what happened into episodes:
/// each run gives `episodes_per_run` environments an episode, one after the other. If the robot
/// falls or arrives, the rest comes from another run, from the next sequence on. What happens in
/// run n of a scene depends on (seed, n) and nothing else, so that neither threads nor other runs
/// matter. Errors: `InputError` for a scenario in which the robot falls over and over again;
/// `Stopped`.
EpisodeBatch roll_out(const RolloutConfig& config, const RolloutScenes& scenes, std::uint64_t seed,
                      std::int64_t first_run, int environments, const RolloutProgress& progress);

/// As many episodes as fit into the scenario's duration, at least one.
int episodes_per_run(const RolloutConfig& config, const scenarios::Scenario& scenario);

/// Runs that `environments` episodes come from.
int runs_for(const RolloutConfig& config, const RolloutScenes& scenes, int environments);

/// Runs of the validation set are numbered from here.
inline constexpr std::int64_t first_validation_run = std::int64_t{1} << 40;

/// What a rollout plays: found, read, and set to the rollout's control step.
RolloutScenes training_scenes(const RolloutConfig& config);
RolloutScenes validation_scenes(const RolloutConfig& config);

}  // namespace touchdown::training
