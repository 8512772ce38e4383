#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/studies/experiment_file.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
using ::testing::ThrowsMessage;

/// Ten lines; appended text begins on the eleventh.
const char* const head = R"(name: study
simulators: [mujoco]
estimators: [robust, phase, measurement_only, reference, paper]
fit: {scenarios: [scenarios/stairs.yaml]}
test: {scenarios: [scenarios/stairs.yaml], runs: 4}
noise:
  torque: [0.0, 1.0]
  accelerometer: [0.0, 5.0]
  joint_velocity: 0.5
  seeds: 3
)";

Experiment read(const std::string& tail) {
  return experiment_from_yaml(YamlDocument::parse(head + tail, "study.yaml"));
}

auto complains(const std::string& place, const std::string& what) {
  return ThrowsMessage<InputError>(AllOf(StartsWith("study.yaml:" + place), HasSubstr(what)));
}

TEST(DropConfig, HasNoFiguresByDefault) {
  const Experiment experiment = read("");
  EXPECT_FALSE(experiment.detail.has_value());
  EXPECT_FALSE(experiment.posterior.has_value());
  EXPECT_THAT(to_yaml(experiment), AllOf(Not(HasSubstr("detail")), Not(HasSubstr("posterior"))));
}

TEST(DropConfig, UsesDefaultsForAnEmptySection) {
  const Experiment experiment = read("detail: {}\nposterior:\n");
  ASSERT_TRUE(experiment.detail && experiment.posterior);
  EXPECT_THAT(experiment.detail->estimators,
              ElementsAre("robust", "measurement_only", "reference", "phase", "paper"));
  ASSERT_EQ(experiment.detail->noise.size(), 2U);
  EXPECT_EQ(experiment.detail->noise[0], (noise::NoiseCell{0.25, 1.0}));
  EXPECT_EQ(experiment.detail->noise[1], (noise::NoiseCell{1.0, 5.0}));
  EXPECT_EQ(experiment.posterior->noise, (noise::NoiseCell{1.0, 5.0}));
  EXPECT_EQ(experiment.posterior->choice.drop, 0);
}

/// The user's own estimators come after the known ones, up to six.
TEST(DropConfig, ShowsTheUsersEstimatorsUpToSix) {
  YamlDocument document = YamlDocument::parse(std::string(head) + "detail: {}\n", "study.yaml");
  document.override_value("estimators=[free_fall, phase, upkie_observer, robust]");
  EXPECT_THAT(experiment_from_yaml(document).detail->estimators,
              ElementsAre("robust", "phase", "free_fall", "upkie_observer"));
  document.override_value(
      "estimators=[oracle, nmn, free_fall, upkie_observer, phase, measurement_only, robust]");
  EXPECT_THAT(experiment_from_yaml(document).detail->estimators,
              ElementsAre("robust", "measurement_only", "phase", "oracle", "nmn", "free_fall"));
}

TEST(DropConfig, ReadsBackUnchanged) {
  const Experiment first = read(
      "detail: {run: 3, wheels: right, drop: 2, seed: 1, before: 0.2, after: 0.3,\n"
      "         noise: [{torque: 2, accelerometer: 0}], estimators: [phase]}\n"
      "posterior: {at: 2.5, noise: {torque: 0, accelerometer: 7}}\n");
  const Experiment again = experiment_from_yaml(YamlDocument::parse(to_yaml(first), "config.yaml"));
  EXPECT_EQ(to_yaml(again), to_yaml(first));
  ASSERT_TRUE(again.detail && again.posterior);
  EXPECT_EQ(again.detail->choice.run, 3);
  EXPECT_EQ(again.detail->choice.seed, 1);
  EXPECT_EQ(again.detail->choice.wheels, DropWheels::right);
  EXPECT_EQ(again.posterior->choice.wheels, DropWheels::both);
  EXPECT_EQ(again.detail->choice.at, std::nullopt);
  EXPECT_EQ(again.posterior->choice.at, 2.5);
  EXPECT_EQ(again.detail->choice.before, 0.2);
  EXPECT_EQ(again.detail->noise[0].wheel, 2.0);
  EXPECT_EQ(again.detail->noise[0].levels().joint_velocity, 0.5);
  EXPECT_EQ(again.posterior->noise.accelerometer, 7.0);
}

TEST(DropConfig, ReportsWrongKeysAndValuesWithTheirPosition) {
  EXPECT_THAT([] { read("detail: {drp: 2}\n"); }, complains("11:10", "did you mean 'drop'?"));
  EXPECT_THAT([] { read("detial: {drop: 2}\n"); }, complains("11:1", "did you mean 'detail'?"));
  EXPECT_THAT([] { read("detail:\n  run: 4\n"); }, complains("12:8", "detail.run"));
  EXPECT_THAT([] { read("detail: {seed: 3}\n"); }, complains("11:", "detail.seed"));
  EXPECT_THAT([] { read("detail: {drop: -1}\n"); }, complains("11:", "detail.drop"));
  EXPECT_THAT([] { read("detail: {after: .nan}\n"); }, complains("11:", "detail.after"));
  EXPECT_THAT([] { read("detail: {wheels: lift}\n"); }, complains("11:18", "did you mean 'left'?"));
  EXPECT_THAT([] { read("detail: {noise: []}\n"); }, complains("11:", "1 to 3 noise settings"));
  EXPECT_THAT([] { read("detail: {noise: [{torque: 1}]}\n"); },
              complains("11:", "detail.noise.0.accelerometer: is missing"));
  EXPECT_THAT([] { read("detail: {noise: [{torque: 1, accelerometer: -2}]}\n"); },
              complains("11:", "detail.noise.0.accelerometer"));
  EXPECT_THAT([] { read("detail: {noise: [{torque: 1, acelerometer: 2, accelerometer: 2}]}\n"); },
              complains("11:", "did you mean 'accelerometer'?"));
  EXPECT_THAT([] { read("detail: {estimators: [robst]}\n"); },
              complains("11:", "did you mean 'robust'?"));
  EXPECT_THAT([] { read("detail: {estimators: [free_fall]}\n"); },
              complains("11:", "detail.estimators"));
  EXPECT_THAT([] { read("detail: 3\n"); }, complains("11:", "expected a mapping"));
  EXPECT_THAT([] { read("posterior: {noise: [1, 2]}\n"); }, complains("11:", "expected a mapping"));
}

TEST(DropConfig, CanSwitchASectionOff) {
  const Experiment experiment =
      read("detail: {drop: 3, enabled: false}\nposterior: {enabled: false}\n");
  EXPECT_FALSE(experiment.detail.has_value());
  EXPECT_FALSE(experiment.posterior.has_value());
  EXPECT_THAT([] { read("detail: {enabled: false, drp: 1}\n"); }, complains("11:", "'drop'"));
}

TEST(DropConfig, NeedsThePhaseFilterForAPosterior) {
  EXPECT_THAT(
      [] {
        YamlDocument document =
            YamlDocument::parse(std::string(head) + "posterior: {}\n", "study.yaml");
        document.override_value("estimators=[robust]");
        experiment_from_yaml(document);
      },
      complains("11:", "'phase' among the experiment's estimators"));
}

}  // namespace
}  // namespace touchdown::experiments
