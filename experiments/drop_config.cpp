#include "experiments/drop_config.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "experiments/read_names.hpp"

namespace touchdown {

namespace {

/// More would not be readable beside, or above, each other.
constexpr std::size_t most_settings = 3;
constexpr std::size_t most_estimators = 6;

DropChoice choice_from_yaml(YamlMap& map, const Experiment& experiment) {
  DropChoice choice;
  map.read("run", choice.run, 0, experiment.test.runs - 1);
  map.read("drop", choice.drop, 0, 1000);
  map.read("seed", choice.seed, 0, experiment.noise.seeds - 1);
  map.read("before", choice.before, 0.0, 10.0);
  map.read("after", choice.after, 0.01, 10.0);
  return choice;
}

void write(const DropChoice& choice, YAML::Node& node) {
  node["run"] = choice.run;
  node["drop"] = choice.drop;
  node["seed"] = choice.seed;
  node["before"] = choice.before;
  node["after"] = choice.after;
}

NoiseCell setting_from_yaml(YamlMap& map) {
  NoiseCell cell;
  map.require("torque", cell.torque);
  map.read("torque", cell.torque, 0.0, 1e3);
  map.require("accelerometer", cell.accelerometer);
  map.read("accelerometer", cell.accelerometer, 0.0, 1e3);
  map.finish();
  cell.knee = cell.wheel = cell.torque;
  return cell;
}

YAML::Node to_node(const NoiseCell& cell) {
  YAML::Node node;
  node["torque"] = cell.torque;
  node["accelerometer"] = cell.accelerometer;
  return node;
}

/// Those that the paper compares and the phase filter; others where the experiment has none of
/// them.
std::vector<std::string> shown_by_default(const std::vector<std::string>& estimators) {
  std::vector<std::string> shown;
  for (const char* name : {"robust", "measurement_only", "reference", "phase"}) {
    if (std::find(estimators.begin(), estimators.end(), name) != estimators.end()) {
      shown.emplace_back(name);
    }
  }
  if (!shown.empty()) return shown;
  shown = estimators;
  if (shown.size() > 4) shown.resize(4);
  return shown;
}

}  // namespace

std::optional<DetailConfig> detail_from_yaml(YamlMap& parent, const Experiment& experiment) {
  const bool wanted = parent.has("detail");
  YamlMap map = parent.child("detail");
  if (!wanted) return std::nullopt;
  bool enabled = true;
  map.read("enabled", enabled);
  DetailConfig detail{.choice = choice_from_yaml(map, experiment)};
  if (map.has("noise")) detail.noise.clear();
  for (YamlMap& setting : map.children("noise")) detail.noise.push_back(setting_from_yaml(setting));
  if (detail.noise.empty() || detail.noise.size() > most_settings) {
    map.fail("noise", fmt::format("expected 1 to {} noise settings", most_settings));
  }
  detail.estimators = shown_by_default(experiment.estimators);
  read_names(map, "estimators", experiment.estimators, detail.estimators);
  if (detail.estimators.size() > most_estimators) {
    map.fail("estimators", fmt::format("expected at most {} names", most_estimators));
  }
  map.finish();
  if (!enabled) return std::nullopt;
  for (NoiseCell& cell : detail.noise) cell = with_encoder_noise(cell, experiment.noise);
  return detail;
}

std::optional<PosteriorConfig> posterior_from_yaml(YamlMap& parent, const Experiment& experiment) {
  const bool wanted = parent.has("posterior");
  YamlMap map = parent.child("posterior");
  if (!wanted) return std::nullopt;
  bool enabled = true;
  map.read("enabled", enabled);
  PosteriorConfig posterior{.choice = choice_from_yaml(map, experiment)};
  if (map.has("noise")) {
    YamlMap setting = map.child("noise");
    posterior.noise = setting_from_yaml(setting);
  }
  map.finish();
  if (!enabled) return std::nullopt;
  const auto& names = experiment.estimators;
  if (std::find(names.begin(), names.end(), "phase") == names.end()) {
    parent.fail("posterior",
                "expected 'phase' among the experiment's estimators, or posterior.enabled: false");
  }
  posterior.noise = with_encoder_noise(posterior.noise, experiment.noise);
  return posterior;
}

YAML::Node to_node(const DetailConfig& detail) {
  YAML::Node node;
  write(detail.choice, node);
  for (const NoiseCell& cell : detail.noise) node["noise"].push_back(to_node(cell));
  node["estimators"] = detail.estimators;
  return node;
}

YAML::Node to_node(const PosteriorConfig& posterior) {
  YAML::Node node;
  write(posterior.choice, node);
  node["noise"] = to_node(posterior.noise);
  return node;
}

}  // namespace touchdown
