#include "training/training_config.hpp"

#include "simulators/simulator.hpp"

namespace touchdown {

namespace {

const std::vector<std::string> contact_names = {"any_wheel", "both_wheels"};

NoiseLevels noise_from_yaml(YamlMap map) {
  NoiseLevels noise;
  map.read("acceleration", noise.acceleration, 0.0, 1e3);
  map.read("joint_position", noise.joint_position, 0.0, 1e3);
  map.read("joint_velocity", noise.joint_velocity, 0.0, 1e3);
  map.finish();
  return noise;
}

LabelConfig labels_from_yaml(YamlMap map) {
  LabelConfig labels;
  map.read("force_threshold", labels.force_threshold, 0.0, 1e4);
  map.read("debounce", labels.debounce, 0.0, 10.0);
  map.finish();
  return labels;
}

RolloutConfig rollout_from_yaml(YamlMap map) {
  RolloutConfig c;
  map.read("scenario", c.scenario);
  std::size_t engine = 0;
  for (const std::string& name : simulator_names()) {
    if (name == c.simulator) break;
    ++engine;
  }
  c.simulator = simulator_names().at(map.choose("simulator", simulator_names(), engine));
  map.read("control_step_us", c.control_step_us, 1000, 1'000'000);
  map.read("environments", c.environments, 1, 1'000'000);
  map.read("steps", c.steps, 1, 1'000'000);
  map.read("sequence", c.sequence, 1, 1'000'000);
  if (c.steps % c.sequence != 0) map.fail("steps", "expected a multiple of `sequence`");
  map.read("skip", c.skip, 0.0, 1e3);
  c.contact = static_cast<RobotContact>(map.choose("contact", contact_names, 0));
  c.labels = labels_from_yaml(map.child("labels"));
  c.noise = noise_from_yaml(map.child("noise"));
  map.finish();
  return c;
}

NetworkSize network_from_yaml(YamlMap map) {
  NetworkSize size;
  constexpr int most = 4096;
  map.read("hidden", size.hidden, 1, most);
  map.read("first", size.first, 1, most);
  map.read("second", size.second, 1, most);
  map.finish();
  return size;
}

OptimiserConfig optimiser_from_yaml(YamlMap map) {
  OptimiserConfig c;
  map.read("iterations", c.iterations, 1, 100'000);
  map.read("epochs", c.epochs, 1, 100'000);
  map.read("learning_rate", c.learning_rate, 1e-12, 1.0);
  map.read("velocity_weight", c.velocity_weight, 0.0, 1e6);
  map.read("patience", c.patience, 1, 100'000);
  map.read("validation_episodes", c.validation_episodes, 1, 10'000'000);
  map.read("parts", c.parts, 1, 1024);
  map.finish();
  return c;
}

}  // namespace

TrainingConfig training_from_yaml(const YamlDocument& document) {
  TrainingConfig config;
  YamlMap map(document);
  map.require("name", config.name);
  map.read("seed", config.seed);
  config.rollout = rollout_from_yaml(map.child("rollout"));
  config.network = network_from_yaml(map.child("network"));
  config.optimiser = optimiser_from_yaml(map.child("optimiser"));
  map.finish();
  return config;
}

std::string to_yaml(const TrainingConfig& config) {
  const RolloutConfig& r = config.rollout;
  YAML::Node labels;
  labels["force_threshold"] = r.labels.force_threshold;
  labels["debounce"] = r.labels.debounce;
  YAML::Node noise;
  noise["acceleration"] = r.noise.acceleration;
  noise["joint_position"] = r.noise.joint_position;
  noise["joint_velocity"] = r.noise.joint_velocity;
  YAML::Node rollout;
  rollout["scenario"] = r.scenario;
  rollout["simulator"] = r.simulator;
  rollout["control_step_us"] = r.control_step_us;
  rollout["environments"] = r.environments;
  rollout["steps"] = r.steps;
  rollout["sequence"] = r.sequence;
  rollout["skip"] = r.skip;
  rollout["contact"] = contact_names.at(static_cast<std::size_t>(r.contact));
  rollout["labels"] = labels;
  rollout["noise"] = noise;
  YAML::Node network;
  network["hidden"] = config.network.hidden;
  network["first"] = config.network.first;
  network["second"] = config.network.second;
  YAML::Node optimiser;
  optimiser["iterations"] = config.optimiser.iterations;
  optimiser["epochs"] = config.optimiser.epochs;
  optimiser["learning_rate"] = config.optimiser.learning_rate;
  optimiser["velocity_weight"] = config.optimiser.velocity_weight;
  optimiser["patience"] = config.optimiser.patience;
  optimiser["validation_episodes"] = config.optimiser.validation_episodes;
  optimiser["parts"] = config.optimiser.parts;
  YAML::Node root;
  root["name"] = config.name;
  root["seed"] = config.seed;
  root["rollout"] = rollout;
  root["network"] = network;
  root["optimiser"] = optimiser;
  return YAML::Dump(root) + "\n";
}

}  // namespace touchdown
