#include "training/config.hpp"

#include <vector>

#include "core/fields.hpp"
#include "core/file_names.hpp"
#include "simulators/registry.hpp"

namespace touchdown::training {

static void describe(Fields& fields, RolloutConfig& rollout) {
  fields("scenarios", rollout.scenarios);
  fields.check(!rollout.scenarios.empty(), "scenarios", "expected at least one scenario file");
  fields.names("simulators", simulators::simulator_names(), rollout.simulators);
  fields("validation_scenarios", rollout.validation_scenarios);
  fields("control_step_us", rollout.control_step_us, 1000, 1'000'000);
  fields("network_step_us", rollout.network_step_us, 1000, 1'000'000);
  fields.check(rollout.network_step_us % rollout.control_step_us == 0, "network_step_us",
               "expected a multiple of `control_step_us`");
  fields("environments", rollout.environments, 1, 1'000'000);
  fields("steps", rollout.steps, 1, 1'000'000);
  fields("sequence", rollout.sequence, 1, 1'000'000);
  fields.check(rollout.steps % rollout.sequence == 0, "steps", "expected a multiple of `sequence`");
  fields("skip", rollout.skip, 0.0, 1e3);
  fields.choose("contact", {"any_wheel", "both_wheels"}, rollout.contact);
  fields.section("labels", rollout.labels);
  fields("sensors", rollout.sensors);
  fields.within("noise", [&](Fields& noise) {
    noise("acceleration", rollout.noise.acceleration, 0.0, 1e3);
    noise("joint_position", rollout.noise.joint_position, 0.0, 1e3);
    noise("joint_velocity", rollout.noise.joint_velocity, 0.0, 1e3);
  });
  std::vector<double>& share = rollout.noise_share;
  fields.in_line("noise_share", share);
  fields.check(share.size() == 2 && 0.0 <= share[0] && share[0] <= share[1], "noise_share",
               "expected [least, most], both at least 0");
}

static void describe(Fields& fields, NetworkSize& size) {
  constexpr int most = 4096;
  fields("hidden", size.hidden, 1, most);
  fields("first", size.first, 1, most);
  fields("second", size.second, 1, most);
}

static void describe(Fields& fields, OptimiserConfig& optimiser) {
  fields("iterations", optimiser.iterations, 1, 100'000);
  fields("epochs", optimiser.epochs, 1, 100'000);
  fields("learning_rate", optimiser.learning_rate, 1e-12, 1.0);
  fields("velocity_weight", optimiser.velocity_weight, 0.0, 1e6);
  fields("patience", optimiser.patience, 1, 100'000);
  fields("validation_episodes", optimiser.validation_episodes, 1, 10'000'000);
  fields("parts", optimiser.parts, 1, 1024);
}

static void describe(Fields& fields, TrainingConfig& config) {
  fields.require("name", config.name);
  fields.check(is_name_word(config.name), "name", expected_name_word);
  fields("seed", config.seed);
  fields.section("rollout", config.rollout);
  fields.section("network", config.network);
  fields.section("optimiser", config.optimiser);
}

TrainingConfig training_from_yaml(const YamlDocument& document) {
  return from_yaml<TrainingConfig>(document);
}

std::string to_yaml(const TrainingConfig& config) { return YAML::Dump(to_node(config)) + "\n"; }

}  // namespace touchdown::training
