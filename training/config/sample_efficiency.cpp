#include "training/config/sample_efficiency.hpp"

#include <algorithm>

#include "core/fields.hpp"
#include "core/file_names.hpp"
#include "experiments/estimators/registry.hpp"
#include "simulators/registry.hpp"

namespace touchdown::training {

namespace {

KeyNotes describe_amounts(Fields& fields, std::string_view key, std::vector<double>& amounts) {
  const KeyNotes notes = fields(key, amounts);
  for (std::size_t i = 0; i < amounts.size(); ++i) {
    fields.check(amounts[i] >= 0.1 && amounts[i] <= 1e6 && (i == 0 || amounts[i] > amounts[i - 1]),
                 key, "expected increasing numbers from 0.1 to 1000000 (s)");
  }
  return notes.range("0.1 to 1000000, increasing");
}

void check_simulator(const Fields& fields, std::string_view key, const std::string& name) {
  const auto& known = simulators::simulator_names();
  fields.check(std::find(known.begin(), known.end(), name) != known.end(), key,
               "unknown physics engine '" + name + "'");
}

}  // namespace

static void describe(Fields& fields, SampleEfficiencyConfig& config) {
  fields.require("name", config.name).doc("Name of the run directory.");
  fields.check(is_name_word(config.name), "name", expected_name_word);
  fields("seed", config.seed).doc("Seed of all random draws.");
  fields("training", config.training).doc("Training file of the network.");
  describe_amounts(fields, "network_seconds", config.network_seconds)
      .doc("s", "Amounts of labelled data for the network, in whole episodes.");
  fields("epochs", config.epochs, 1, 100'000).doc("Epochs over the same data.");
  describe_amounts(fields, "filter_seconds", config.filter_seconds)
      .doc("s", "Amounts of labelled data for the Bayes filter.");
  fields("estimator", config.estimator).doc("The Bayes filter.");
  fields.check("estimator", [&] {
    if (!experiments::estimator_entry(config.estimator).config)
      throw InputError("expected a Bayes filter");
  });
  fields("fit_scenarios", config.fit_scenarios)
      .doc("Scenarios of the labelled data, in equal parts.");
  fields.check(!config.fit_scenarios.empty(), "fit_scenarios",
               "expected at least one scenario file");
  fields("fit_simulator", config.fit_simulator).doc("Engine of the labelled data.");
  check_simulator(fields, "fit_simulator", config.fit_simulator);
  fields("test_scenario", config.test_scenario).doc("Scenario of the test runs.");
  fields("simulators", config.simulators).doc("Engines of the test runs.");
  fields.check(!config.simulators.empty(), "simulators", "expected at least one name");
  for (const std::string& name : config.simulators) check_simulator(fields, "simulators", name);
  fields("runs", config.runs, 1, 100'000).doc("Test runs in each engine.");
  const auto describe_noise = [&](Fields& noise) {
    noise("torque", config.noise.torque, 0.0, 1e3).doc("N·m", "Noise on knee and wheel torques.");
    noise("accelerometer", config.noise.accelerometer, 0.0, 1e3)
        .doc("m/s²", "Noise on each acceleration.");
  };
  fields.within("noise", describe_noise).doc("White noise on the signals of the test runs.");
}

bool is_sample_efficiency(const YamlDocument& document) {
  return document.root().IsMap() && document.root()["network_seconds"].IsDefined();
}

SampleEfficiencyConfig sample_efficiency_from_yaml(const YamlDocument& document) {
  return from_yaml<SampleEfficiencyConfig>(document);
}

std::vector<Key> sample_efficiency_keys() { return documented_keys(SampleEfficiencyConfig()); }

std::string to_yaml(const SampleEfficiencyConfig& config) {
  return YAML::Dump(to_node(config)) + "\n";
}

}  // namespace touchdown::training
