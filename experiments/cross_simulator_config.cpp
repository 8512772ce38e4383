#include "experiments/cross_simulator_config.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace touchdown {

namespace {

constexpr const char* section_name = "cross_simulator";

/// Names that the experiment itself must have.
void read_subset(YamlMap& map, std::string_view key, const std::vector<std::string>& known,
                 std::vector<std::string>& names) {
  map.read(key, names);
  for (const std::string& name : names) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    const std::string near = nearest(name, known);
    map.fail(key,
             fmt::format("'{}' is not one of the experiment's: {}{}", name, fmt::join(known, ", "),
                         near.empty() ? "" : fmt::format(" (did you mean '{}'?)", near)));
  }
}

Factor factor_from_yaml(YamlMap& map, const Experiment& experiment) {
  Factor factor;
  map.require("key", factor.key);
  factor.name = factor.key;
  map.read("name", factor.name);
  map.require("values", factor.values);
  if (factor.values.empty()) map.fail("values", "expected at least one number");
  read_subset(map, "simulators", experiment.simulators, factor.simulators);
  if (factor.simulators.empty()) factor.simulators = experiment.simulators;
  map.finish();
  return factor;
}

}  // namespace

bool is_cross_simulator(const YamlDocument& document) {
  return document.root().IsMap() && document.root()[section_name].IsDefined();
}

CrossSimulator cross_simulator_from_yaml(YamlDocument& document) {
  YAML::Node root = document.root();
  const YAML::Node node = root[section_name];
  YamlMap section(node, document.name(), section_name);
  root.remove(section_name);

  CrossSimulator config;
  config.experiment = experiment_from_yaml(document);
  const Experiment& experiment = config.experiment;
  if (experiment.simulators.size() != 2) {
    YamlMap(document).fail("simulators", "expected two engines to compare");
  }
  YamlMap sensitivity = section.child("sensitivity");
  config.sensitivity_runs = std::min(config.sensitivity_runs, experiment.test.runs);
  sensitivity.read("runs", config.sensitivity_runs, 1, 100'000);
  if (config.sensitivity_runs > experiment.test.runs) {
    sensitivity.fail("runs", fmt::format("expected at most test.runs, {}", experiment.test.runs));
  }
  for (YamlMap& map : sensitivity.children("factors")) {
    config.factors.push_back(factor_from_yaml(map, experiment));
  }
  sensitivity.finish();
  YamlMap verdict = section.child("verdict");
  verdict.read("largest_loss", config.verdict.largest_loss, 0.0, 1.0);
  verdict.read("smallest_gain", config.verdict.smallest_gain, -1.0, 1.0);
  read_subset(verdict, "demanded", experiment.estimators, config.verdict.demanded);
  verdict.finish();
  YamlMap overlay = section.child("overlay");
  overlay.read("run", config.overlay.run, 0, experiment.test.runs - 1);
  overlay.read("drop", config.overlay.drop, 0, 1000);
  overlay.finish();
  section.finish();
  return config;
}

std::string to_yaml(const CrossSimulator& config) {
  YAML::Node section;
  section["sensitivity"]["runs"] = config.sensitivity_runs;
  for (const Factor& factor : config.factors) {
    YAML::Node node;
    node["name"] = factor.name;
    node["key"] = factor.key;
    node["values"] = factor.values;
    node["simulators"] = factor.simulators;
    section["sensitivity"]["factors"].push_back(node);
  }
  section["verdict"]["largest_loss"] = config.verdict.largest_loss;
  section["verdict"]["smallest_gain"] = config.verdict.smallest_gain;
  section["verdict"]["demanded"] = config.verdict.demanded;
  section["overlay"]["run"] = config.overlay.run;
  section["overlay"]["drop"] = config.overlay.drop;
  YAML::Node node;
  node[section_name] = section;
  YAML::Emitter emitter;
  emitter << node;
  return to_yaml(config.experiment) + emitter.c_str() + "\n";
}

}  // namespace touchdown
