#include "apps/training/config/training.hpp"

#include <vector>

#include "core/fields.hpp"
#include "core/files.hpp"
#include "experiments/config/yaml_kind.hpp"
#include "simulators/registry.hpp"

namespace touchdown::training {

static void describe(Fields& fields, RolloutConfig& rollout) {
  fields("scenarios", rollout.scenarios).doc("Scenarios of successive runs, in turn.");
  fields.check(!rollout.scenarios.empty(), "scenarios", "expected at least one scenario file");
  fields.names("simulators", simulators::simulator_names(), rollout.simulators)
      .doc("Physics engines, one after the other.");
  fields("validation_scenarios", rollout.validation_scenarios)
      .doc("Scenarios that select the best iteration; if empty, `scenarios`.");
  fields("control_step_us", rollout.control_step_us, 1000, 1'000'000)
      .doc("µs", "Control and measurement period.");
  fields("network_step_us", rollout.network_step_us, 1000, 1'000'000)
      .doc("µs", "Period of the network, a multiple of `control_step_us`.");
  fields.check(rollout.network_step_us % rollout.control_step_us == 0, "network_step_us",
               "expected a multiple of `control_step_us`");
  fields("environments", rollout.environments, 1, 1'000'000).doc("Episodes per iteration.");
  fields("steps", rollout.steps, 1, 1'000'000)
      .doc("Steps of an episode, a multiple of `sequence`.");
  fields("sequence", rollout.sequence, 1, 1'000'000).doc("Steps of truncated backpropagation.");
  fields.check(rollout.steps % rollout.sequence == 0, "steps", "expected a multiple of `sequence`");
  fields("skip", rollout.skip, 0.0, 1e3).doc("s", "Time of every run before its first episode.");
  fields.choose("contact", {"any_wheel", "both_wheels"}, rollout.contact)
      .doc("When the robot is in contact, given its wheels.");
  fields.section("labels", rollout.labels).doc("When a wheel counts as being in contact.");
  fields("sensors", rollout.sensors).doc("Sensor profile of the inputs; empty: ideal sensors.");
  const auto describe_noise = [&](Fields& noise) {
    noise("acceleration", rollout.noise.acceleration, 0.0, 1e3)
        .doc("m/s²", "Noise on each acceleration.");
    noise("joint_position", rollout.noise.joint_position, 0.0, 1e3)
        .doc("rad", "Noise on each joint position.");
    noise("joint_velocity", rollout.noise.joint_velocity, 0.0, 1e3)
        .doc("rad/s", "Noise on each joint velocity.");
  };
  fields.within("noise", describe_noise).doc("White noise on the inputs.");
  std::vector<double>& share = rollout.noise_share;
  fields.in_line("noise_share", share)
      .type("list of least, most")
      .range("≥ 0")
      .doc("Range from which each run draws a factor on the noise.");
  fields.check(share.size() == 2 && 0.0 <= share[0] && share[0] <= share[1], "noise_share",
               "expected [least, most], both at least 0");
}

static void describe(Fields& fields, NetworkSize& size) {
  constexpr int most = 4096;
  fields("hidden", size.hidden, 1, most).doc("Units of the recurrent layer.");
  fields("first", size.first, 1, most).doc("Units of the first layer after it.");
  fields("second", size.second, 1, most).doc("Units of the second layer after it.");
}

static void describe(Fields& fields, OptimiserConfig& optimiser) {
  fields("iterations", optimiser.iterations, 1, 100'000)
      .doc("Iterations at most, each with new data.");
  fields("epochs", optimiser.epochs, 1, 100'000).doc("Epochs over the data of an iteration.");
  fields("learning_rate", optimiser.learning_rate, 1e-12, 1.0).doc("Learning rate of Adam.");
  fields("velocity_weight", optimiser.velocity_weight, 0.0, 1e6)
      .doc("s²/m²", "Weight of the squared velocity error against the cross-entropy.");
  fields("patience", optimiser.patience, 1, 100'000)
      .doc("Iterations without a better validation loss before training stops.");
  fields("validation_episodes", optimiser.validation_episodes, 1, 10'000'000)
      .doc("Episodes for validation only.");
  fields("parts", optimiser.parts, 1, 1024).doc("Parts of a batch with gradients in parallel.");
}

static void describe(Fields& fields, TrainingConfig& config) {
  experiments::describe_base(fields);
  fields.require("name", config.name).doc("Name of the run directory and of the model.");
  fields.check(is_name_word(config.name), "name", expected_name_word);
  fields("seed", config.seed).doc("Seed of all random draws.");
  fields.section("rollout", config.rollout).doc("How labelled data is generated.");
  fields.section("network", config.network).doc("Layer sizes.");
  fields.section("optimiser", config.optimiser).doc("Settings of the optimiser.");
}

TrainingConfig training_from_yaml(const YamlDocument& document) {
  return from_yaml<TrainingConfig>(document);
}

std::vector<Key> training_keys() { return documented_keys(TrainingConfig()); }

std::string to_yaml(const TrainingConfig& config) { return YAML::Dump(to_node(config)) + "\n"; }

}  // namespace touchdown::training
