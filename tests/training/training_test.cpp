#include "apps/training/config/training.hpp"

#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/complaint.hpp"
#include "tests/documented_defaults.hpp"

namespace touchdown::training {
namespace {

using testing::HasSubstr;
using ::testing::IsEmpty;

TrainingConfig parsed(const std::string& text) {
  return training_from_yaml(YamlDocument::parse(text, "t.yaml"));
}

TEST(TrainingConfig, TheShippedFileMatchesThePaper) {
  const TrainingConfig c =
      training_from_yaml(YamlDocument::load(TOUCHDOWN_SOURCE_DIR "/experiments/nmn.yaml"));
  EXPECT_EQ(c.rollout.simulators, std::vector<std::string>{"bullet"});
  EXPECT_EQ(c.rollout.period(), 0.005);
  EXPECT_EQ(c.rollout.environments * c.rollout.steps * c.optimiser.iterations, 4'000'000);
  EXPECT_EQ(c.optimiser.validation_episodes * c.rollout.steps, 400'000);
  EXPECT_EQ(c.rollout.sequence, 10);
  EXPECT_EQ(c.optimiser.epochs, 32);
  EXPECT_EQ(c.optimiser.learning_rate, 5e-4);
  EXPECT_EQ(c.network.hidden, 128);
}

TEST(TrainingConfig, WritesEveryValue) {
  const TrainingConfig c = parsed(
      "{name: x, seed: 7, rollout: {contact: both_wheels, steps: 30, noise: {acceleration: 0.3}}, "
      "network: {hidden: 3}, optimiser: {parts: 2}}");
  const std::string text = to_yaml(c);
  EXPECT_EQ(to_yaml(parsed(text)), text);
  EXPECT_EQ(parsed(text).rollout.contact, RobotContact::both_wheels);
  EXPECT_EQ(parsed(text).rollout.noise.acceleration, 0.3);
  EXPECT_EQ(parsed(text).optimiser.parts, 2);
}

TEST(TrainingConfig, NamesTheWrongValue) {
  for (const auto& [text, message] : std::map<std::string, const char*>{
           {"{seed: 1}", "name"},
           {"{name: x, rolout: {}}", "did you mean 'rollout'"},
           {"{name: x, rollout: {simulators: [bulet]}}", "bullet"},
           {"{name: x, rollout: {steps: 25}}", "multiple of `sequence`"},
           {"{name: x, rollout: {control_step_us: 2000}}", "multiple of `control_step_us`"},
           {"{name: x, rollout: {noise_share: [1, 0]}}", "[least, most]"},
           {"{name: x, rollout: {noise_share: [0.5]}}", "[least, most]"},
           {"{name: x, rollout: {scenarios: []}}", "at least one scenario"},
           {"{name: x, optimiser: {epochs: 0}}", "epochs"},
           {"{name: x, network: {hidden: many}}", "whole number"}}) {
    EXPECT_THAT(complaint_of([&, yaml = text] { parsed(yaml); }), HasSubstr(message));
  }
}

TEST(TrainingKeys, HaveTheDefaultsOfAFileThatGivesNone) {
  const auto compared = tests::compared_defaults(training_keys(), to_yaml(TrainingConfig()));
  EXPECT_THAT(compared.different, IsEmpty());
  EXPECT_GT(compared.equal, 25U);
}

}  // namespace
}  // namespace touchdown::training
