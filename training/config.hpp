#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/yaml.hpp"
#include "noise/sensor_noise.hpp"
#include "scoring/labels.hpp"
#include "training/trainer.hpp"

namespace touchdown::training {

/// When the robot counts as being in contact, from its two wheels.
enum class RobotContact : int {
  any_wheel,   ///< it touches the ground: no contact means that it flies
  both_wheels  ///< it stands on both wheels
};

/// How labelled data comes about: episodes of parallel environments, cut from runs of scenarios.
struct RolloutConfig {
  /// Run after run the next one of these, and after the last one the first in the next engine.
  std::vector<std::string> scenarios = {"scenarios/lift.yaml"};
  std::vector<std::string> simulators = {"bullet"};
  /// Whose loss decides which iteration's weights are kept; none: those above.
  std::vector<std::string> validation_scenarios = {};
  std::int64_t control_step_us = 5000;  ///< at which the robot is steered and heard
  std::int64_t network_step_us = 5000;  ///< one step of the network: a multiple of the other
  int environments = 400;               ///< episodes per iteration
  int steps = 400;                      ///< of an episode; a multiple of `sequence`
  int sequence = 10;                    ///< steps that gradients are carried back through
  double skip = 0.0;                    ///< of every run, before its first episode begins (s)
  RobotContact contact = RobotContact::any_wheel;
  scoring::LabelConfig labels;
  std::string sensors;       ///< the profile that the network hears through; empty: ideal
  noise::SensorNoise noise;  ///< on top of that; the paper trains without
  /// Each run has a share of the noise between these.
  std::vector<double> noise_share = {1.0, 1.0};

  /// Of the network (s).
  double period() const { return 1e-6 * static_cast<double>(network_step_us); }
  /// Control steps to one of the network.
  int stride() const { return static_cast<int>(network_step_us / control_step_us); }
};

/// Numbers of features between inputs and outputs.
struct NetworkSize {
  int hidden = 128;  ///< of the GRU
  int first = 256;   ///< of the perceptron behind it
  int second = 128;
};

/// A training file, seen whole: the paper's Section V, paragraphs "Simulation" and "Training".
struct TrainingConfig {
  std::string name = "nmn";
  std::uint64_t seed = 1;
  RolloutConfig rollout;
  NetworkSize network;
  OptimiserConfig optimiser;
};

/// Reads a training file strictly. Errors: `InputError` with file:line:column.
TrainingConfig training_from_yaml(const YamlDocument& document);

/// The same with every default written out; reads back to the same.
std::string to_yaml(const TrainingConfig& config);

}  // namespace touchdown::training
