#include "experiments/experiment.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "experiments/drop_config.hpp"
#include "experiments/estimator_registry.hpp"
#include "experiments/read_names.hpp"
#include "simulators/simulator.hpp"

namespace touchdown {

namespace {

const std::vector<std::string> sample_units = {"run", "drop"};

RunsConfig runs_from_yaml(YamlMap map, RunsConfig runs) {
  map.require("scenarios", runs.scenarios);
  if (runs.scenarios.empty()) map.fail("scenarios", "expected at least one scenario file");
  map.read("runs", runs.runs, 1, 100'000);
  map.read("perturbed", runs.perturbed);
  map.finish();
  return runs;
}

YAML::Node to_node(const RunsConfig& runs) {
  YAML::Node node;
  node["scenarios"] = runs.scenarios;
  node["runs"] = runs.runs;
  node["perturbed"] = runs.perturbed;
  return node;
}

/// Sorted without repetition, so that a grid is a grid.
void read_levels(YamlMap& map, std::string_view key, std::vector<double>& levels) {
  map.read(key, levels);
  if (levels.empty()) map.fail(key, "expected at least one number");
  for (std::size_t i = 0; i < levels.size(); ++i) {
    if (!(levels[i] >= 0.0 && levels[i] <= 1e3)) map.fail(key, "expected numbers from 0 to 1000");
    if (i > 0 && !(levels[i] > levels[i - 1])) map.fail(key, "expected increasing numbers");
  }
}

NoiseGridConfig noise_from_yaml(YamlMap map) {
  NoiseGridConfig noise;
  read_levels(map, "torque", noise.torque);
  read_levels(map, "accelerometer", noise.accelerometer);
  if (map.has("knee_wheel")) {
    YamlMap grid = map.child("knee_wheel");
    for (const char* joint : {"knee", "wheel"}) {
      if (!grid.has(joint)) grid.fail(joint, "is missing");
    }
    read_levels(grid, "knee", noise.knee_wheel.knee);
    read_levels(grid, "wheel", noise.knee_wheel.wheel);
    grid.read("accelerometer", noise.knee_wheel.accelerometer, 0.0, 1e3);
    grid.finish();
  }
  map.read("joint_position", noise.joint_position, 0.0, 1e3);
  map.read("joint_velocity", noise.joint_velocity, 0.0, 1e3);
  map.read("seeds", noise.seeds, 1, 100'000);
  map.finish();
  return noise;
}

YAML::Node to_node(const NoiseGridConfig& noise) {
  YAML::Node node;
  node["torque"] = noise.torque;
  node["accelerometer"] = noise.accelerometer;
  if (const KneeWheelGridConfig& grid = noise.knee_wheel; !grid.knee.empty()) {
    node["knee_wheel"]["knee"] = grid.knee;
    node["knee_wheel"]["wheel"] = grid.wheel;
    node["knee_wheel"]["accelerometer"] = grid.accelerometer;
  }
  node["joint_position"] = noise.joint_position;
  node["joint_velocity"] = noise.joint_velocity;
  node["seeds"] = noise.seeds;
  return node;
}

/// Cells that the grid must have; its first one if none are named.
std::vector<NoiseCell> highlights_from_yaml(YamlMap& parent, const NoiseGridConfig& noise) {
  std::vector<NoiseCell> cells;
  const auto on_grid = [](YamlMap& map, const char* key, const std::vector<double>& levels) {
    double level = 0.0;
    map.require(key, level);
    if (std::find(levels.begin(), levels.end(), level) == levels.end()) {
      map.fail(key, fmt::format("expected one of noise.{}: {}", key, fmt::join(levels, ", ")));
    }
    return level;
  };
  for (YamlMap& map : parent.children("highlights")) {
    const double torque = on_grid(map, "torque", noise.torque);
    cells.push_back({torque, on_grid(map, "accelerometer", noise.accelerometer)});
    map.finish();
  }
  if (cells.empty()) cells.push_back({noise.torque.front(), noise.accelerometer.front()});
  for (NoiseCell& cell : cells) cell = with_encoder_noise(cell, noise);
  return cells;
}

YAML::Node to_node(const std::vector<NoiseCell>& cells) {
  YAML::Node node;
  for (const NoiseCell& cell : cells) {
    YAML::Node item;
    item["torque"] = cell.torque;
    item["accelerometer"] = cell.accelerometer;
    node.push_back(item);
  }
  return node;
}

LabelConfig labels_from_yaml(YamlMap map) {
  LabelConfig labels;
  map.read("force_threshold", labels.force_threshold, 0.0, 1e4);
  map.read("debounce", labels.debounce, 0.0, 10.0);
  map.finish();
  return labels;
}

YAML::Node to_node(const LabelConfig& labels) {
  YAML::Node node;
  node["force_threshold"] = labels.force_threshold;
  node["debounce"] = labels.debounce;
  return node;
}

ScoringConfig scoring_from_yaml(YamlMap map) {
  ScoringConfig scoring;
  map.read("skip", scoring.skip, 0.0, 1e3);
  map.read("hold_off", scoring.hold_off, 0.0, 10.0);
  map.read("takeoff_opens", scoring.takeoff_opens, 0.0, 10.0);
  map.read("landing_opens", scoring.landing_opens, 0.0, 10.0);
  map.read("minimum_flight", scoring.minimum_flight, 0.0, 10.0);
  map.finish();
  return scoring;
}

YAML::Node to_node(const ScoringConfig& scoring) {
  YAML::Node node;
  node["skip"] = scoring.skip;
  node["hold_off"] = scoring.hold_off;
  node["takeoff_opens"] = scoring.takeoff_opens;
  node["landing_opens"] = scoring.landing_opens;
  node["minimum_flight"] = scoring.minimum_flight;
  return node;
}

IntervalConfig intervals_from_yaml(YamlMap map) {
  IntervalConfig intervals;
  intervals.over = static_cast<SampleUnit>(map.choose("over", sample_units, 0));
  map.read("resamples", intervals.bootstrap.resamples, 10, 1'000'000);
  map.read("level", intervals.bootstrap.level, 0.5, 0.999);
  map.read("seed", intervals.bootstrap.seed);
  map.finish();
  return intervals;
}

YAML::Node to_node(const IntervalConfig& intervals) {
  YAML::Node node;
  node["over"] = sample_units[static_cast<std::size_t>(intervals.over)];
  node["resamples"] = intervals.bootstrap.resamples;
  node["level"] = intervals.bootstrap.level;
  node["seed"] = intervals.bootstrap.seed;
  return node;
}

VideoConfig video_from_yaml(YamlMap map, const Experiment& experiment) {
  VideoConfig video;
  map.read("enabled", video.enabled);
  map.read("run", video.run, 0, experiment.test.runs - 1);
  video.estimators = {experiment.estimators.front()};
  read_names(map, "estimators", experiment.estimators, video.estimators);
  map.read("torque_noise", video.torque_noise, 0.0, 1e3);
  map.read("accelerometer_noise", video.accelerometer_noise, 0.0, 1e3);
  map.finish();
  return video;
}

YAML::Node to_node(const VideoConfig& video) {
  YAML::Node node;
  node["enabled"] = video.enabled;
  node["run"] = video.run;
  node["estimators"] = video.estimators;
  node["torque_noise"] = video.torque_noise;
  node["accelerometer_noise"] = video.accelerometer_noise;
  return node;
}

}  // namespace

Experiment experiment_from_yaml(const YamlDocument& document) {
  YamlMap map(document);
  Experiment experiment;
  map.require("name", experiment.name);
  if (experiment.name.empty() || experiment.name.find_first_of("/\\ \t\n.") != std::string::npos) {
    map.fail("name", "expected a word that can name a folder");
  }
  map.read("seed", experiment.seed);
  read_names(map, "simulators", simulator_names(), experiment.simulators);
  read_names(map, "estimators", estimator_names(), experiment.estimators);
  for (const char* section : {"fit", "test"}) {
    if (!map.has(section)) map.fail(section, "is missing");
  }
  experiment.fit =
      runs_from_yaml(map.child("fit"), {.scenarios = {}, .runs = 1, .perturbed = false});
  experiment.test =
      runs_from_yaml(map.child("test"), {.scenarios = {}, .runs = 8, .perturbed = true});
  experiment.noise = noise_from_yaml(map.child("noise"));
  experiment.highlights = highlights_from_yaml(map, experiment.noise);
  experiment.labels = labels_from_yaml(map.child("labels"));
  experiment.scoring = scoring_from_yaml(map.child("scoring"));
  experiment.intervals = intervals_from_yaml(map.child("intervals"));
  experiment.video = video_from_yaml(map.child("video"), experiment);
  experiment.detail = detail_from_yaml(map, experiment);
  experiment.posterior = posterior_from_yaml(map, experiment);
  map.read("paper_tables", experiment.paper_tables);
  map.read("workers", experiment.workers, 0, 4096);
  map.finish();
  return experiment;
}

std::string to_yaml(const Experiment& experiment) {
  YAML::Node node;
  node["name"] = experiment.name;
  node["seed"] = experiment.seed;
  node["simulators"] = experiment.simulators;
  node["estimators"] = experiment.estimators;
  node["fit"] = to_node(experiment.fit);
  node["test"] = to_node(experiment.test);
  node["noise"] = to_node(experiment.noise);
  node["highlights"] = to_node(experiment.highlights);
  node["labels"] = to_node(experiment.labels);
  node["scoring"] = to_node(experiment.scoring);
  node["intervals"] = to_node(experiment.intervals);
  node["video"] = to_node(experiment.video);
  if (experiment.detail) node["detail"] = to_node(*experiment.detail);
  if (experiment.posterior) node["posterior"] = to_node(*experiment.posterior);
  node["paper_tables"] = experiment.paper_tables;
  YAML::Emitter emitter;
  emitter << node;
  return std::string(emitter.c_str()) + "\n";
}

}  // namespace touchdown
