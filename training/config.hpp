#pragma once

#include <cstdint>
#include <string>

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

/// How labelled data comes about: episodes of parallel environments, cut from runs of a scenario.
struct RolloutConfig {
  std::string scenario = "scenarios/lift.yaml";
  std::string simulator = "bullet";
  std::int64_t control_step_us = 5000;  ///< one step of the network
  int environments = 400;               ///< episodes per iteration
  int steps = 400;                      ///< of an episode; a multiple of `sequence`
  int sequence = 10;                    ///< steps that gradients are carried back through
  double skip = 0.0;                    ///< of every run, before its first episode begins (s)
  RobotContact contact = RobotContact::any_wheel;
  scoring::LabelConfig labels;
  noise::SensorNoise noise;  ///< of the sensors; the paper trains without

  double period() const { return 1e-6 * static_cast<double>(control_step_us); }
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
