#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/training/config/optimiser.hpp"
#include "core/key.hpp"
#include "core/yaml.hpp"
#include "noise/sensor_noise.hpp"
#include "scoring/labels.hpp"

namespace touchdown::training {

/// When the robot is in contact, given its two wheels.
enum class RobotContact : int {
  any_wheel,   ///< at least one wheel in contact: no contact means flight
  both_wheels  ///< both wheels in contact
};

/// How labelled data is generated: episodes of parallel environments, cut from runs of scenarios.
struct RolloutConfig {
  /// Successive runs use these in turn, first all in one engine, then all in the next.
  std::vector<std::string> scenarios = {"scenarios/lift.yaml"};
  std::vector<std::string> simulators = {"bullet"};
  /// The loss in these selects the iteration with the kept weights; if empty, `scenarios` are used.
  std::vector<std::string> validation_scenarios = {};
  std::int64_t control_step_us = 5000;  ///< control and measurement period (µs)
  std::int64_t network_step_us =
      5000;                ///< period of the network (µs), a multiple of `control_step_us`
  int environments = 400;  ///< episodes per iteration
  int steps = 400;         ///< steps of an episode; a multiple of `sequence`
  int sequence = 10;       ///< steps of truncated backpropagation
  double skip = 0.0;       ///< time of every run before its first episode (s)
  RobotContact contact = RobotContact::any_wheel;
  scoring::LabelConfig labels;
  std::string sensors;       ///< sensor profile of the inputs; empty: ideal
  noise::SensorNoise noise;  ///< added to the inputs; the paper trains without
  /// Each run draws a factor on the noise, uniformly between these.
  std::vector<double> noise_share = {1.0, 1.0};

  /// Period of the network (s).
  double period() const { return 1e-6 * static_cast<double>(network_step_us); }
  /// Control steps per step of the network.
  int stride() const { return static_cast<int>(network_step_us / control_step_us); }
};

struct NetworkSize {
  int hidden = 128;  ///< of the GRU
  int first = 256;   ///< first layer of the perceptron after it
  int second = 128;  ///< its second layer
};

/// A training file: the paper's Section V, paragraphs "Simulation" and "Training".
struct TrainingConfig {
  std::string name = "nmn";
  std::uint64_t seed = 1;
  RolloutConfig rollout;
  NetworkSize network;
  OptimiserConfig optimiser;
};

/// Reads a training file strictly. Errors: `InputError` with file:line:column.
TrainingConfig training_from_yaml(const YamlDocument& document);

/// The configuration as YAML with every default; it reads back to the same configuration.
std::string to_yaml(const TrainingConfig& config);

std::vector<Key> training_keys();

}  // namespace touchdown::training
