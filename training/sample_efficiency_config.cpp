#include <algorithm>

#include "core/error.hpp"
#include "experiments/estimator_registry.hpp"
#include "simulators/simulator.hpp"
#include "training/sample_efficiency.hpp"

namespace touchdown {

namespace {

void read_amounts(YamlMap& map, std::string_view key, std::vector<double>& amounts) {
  map.read(key, amounts);
  for (std::size_t i = 0; i < amounts.size(); ++i) {
    if (!(amounts[i] >= 0.1 && amounts[i] <= 1e6) || (i > 0 && amounts[i] <= amounts[i - 1])) {
      map.fail(key, "expected increasing numbers from 0.1 to 1000000 (s)");
    }
  }
}

void check_simulator(const YamlMap& map, std::string_view key, const std::string& name) {
  const auto& known = simulator_names();
  if (std::find(known.begin(), known.end(), name) == known.end()) {
    map.fail(key, "unknown physics engine '" + name + "'");
  }
}

}  // namespace

bool is_sample_efficiency(const YamlDocument& document) {
  return document.root().IsMap() && document.root()["network_seconds"].IsDefined();
}

SampleEfficiencyConfig sample_efficiency_from_yaml(const YamlDocument& document) {
  SampleEfficiencyConfig c;
  YamlMap map(document);
  map.require("name", c.name);
  map.read("seed", c.seed);
  map.read("training", c.training);
  read_amounts(map, "network_seconds", c.network_seconds);
  map.read("epochs", c.epochs, 1, 100'000);
  read_amounts(map, "filter_seconds", c.filter_seconds);
  map.read("estimator", c.estimator);
  try {
    if (!estimator_entry(c.estimator).config) throw InputError("expected a Bayes filter");
  } catch (const InputError& error) {
    map.fail("estimator", error.what());
  }
  map.read("fit_scenarios", c.fit_scenarios);
  if (c.fit_scenarios.empty()) map.fail("fit_scenarios", "expected at least one scenario file");
  map.read("fit_simulator", c.fit_simulator);
  check_simulator(map, "fit_simulator", c.fit_simulator);
  map.read("test_scenario", c.test_scenario);
  map.read("simulators", c.simulators);
  if (c.simulators.empty()) map.fail("simulators", "expected at least one name");
  for (const std::string& name : c.simulators) check_simulator(map, "simulators", name);
  map.read("runs", c.runs, 1, 100'000);
  YamlMap noise = map.child("noise");
  noise.read("torque", c.noise.torque, 0.0, 1e3);
  noise.read("accelerometer", c.noise.accelerometer, 0.0, 1e3);
  noise.finish();
  map.finish();
  return c;
}

std::string to_yaml(const SampleEfficiencyConfig& c) {
  YAML::Node noise;
  noise["torque"] = c.noise.torque;
  noise["accelerometer"] = c.noise.accelerometer;
  YAML::Node root;
  root["name"] = c.name;
  root["seed"] = c.seed;
  root["training"] = c.training;
  root["network_seconds"] = c.network_seconds;
  root["epochs"] = c.epochs;
  root["filter_seconds"] = c.filter_seconds;
  root["estimator"] = c.estimator;
  root["fit_scenarios"] = c.fit_scenarios;
  root["fit_simulator"] = c.fit_simulator;
  root["test_scenario"] = c.test_scenario;
  root["simulators"] = c.simulators;
  root["runs"] = c.runs;
  root["noise"] = noise;
  return YAML::Dump(root) + "\n";
}

}  // namespace touchdown
