#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/keys/key.hpp"
#include "core/yaml.hpp"
#include "noise/grid.hpp"

namespace touchdown::training {

/// A study of contact accuracy by amount of labelled data.
struct SampleEfficiencyConfig {
  std::string name = "sample_efficiency";
  std::uint64_t seed = 1;
  std::string training = "experiments/nmn.yaml";  ///< how the network is trained
  /// Labelled data for training the network (s), rounded to whole episodes. The shipped network is
  /// one more point.
  std::vector<double> network_seconds = {8.0, 40.0, 200.0, 800.0};
  int epochs = 64;  ///< over the same data: twice those of the training file, as there is less data
  /// Labelled data for fitting the Bayes filter (s), in equal parts from `fit_scenarios`.
  std::vector<double> filter_seconds = {2.0, 8.0, 40.0, 200.0, 800.0};
  std::string estimator = "robust";  ///< the filter
  std::vector<std::string> fit_scenarios = {"scenarios/roam.yaml", "scenarios/hang.yaml"};
  std::string fit_simulator = "bullet";  ///< engine of the labelled data
  std::string test_scenario = "scenarios/stairs.yaml";
  std::vector<std::string> simulators = {"mujoco", "bullet"};
  int runs = 4;  ///< of the test scenario, in each engine
  noise::NoiseCell noise;
};

/// Errors: `InputError`.
SampleEfficiencyConfig sample_efficiency_from_yaml(const YamlDocument& document);
std::string to_yaml(const SampleEfficiencyConfig& config);

/// Whether a document describes such a study rather than a training.
bool is_sample_efficiency(const YamlDocument& document);

/// The keys of such a file.
std::vector<Key> sample_efficiency_keys();

}  // namespace touchdown::training
