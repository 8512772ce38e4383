#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/config/experiment.hpp"
#include "experiments/config/experiment_yaml.hpp"
#include "experiments/plan/request.hpp"
#include "tests/documented_defaults.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

const char* const head = R"(name: study
simulators: [mujoco]
estimators: [robust, load_filter, measurement_only, reference, paper]
fit: {scenarios: [scenarios/stairs.yaml]}
test: {scenarios: [scenarios/stairs.yaml], runs: 4}
noise:
  torque: [0.0, 1.0]
  accelerometer: [0.0, 5.0]
  joint_velocity: 0.5
  seeds: 3
)";

Experiment read(const std::string& tail, const std::vector<std::string>& set = {}) {
  YamlDocument document = YamlDocument::parse(head + tail, "study.yaml");
  for (const std::string& assignment : set) document.override_value(assignment);
  return experiment_from_yaml(document);
}

Experiment read_again(const Experiment& experiment) {
  return experiment_from_yaml(YamlDocument::parse(to_yaml(experiment), "config.yaml"));
}

YamlDocument document_with(const std::string& scenarios) {
  return YamlDocument::parse(
      "name: drawn\nfit: {scenarios: [scenarios/stairs.yaml]}\ntest:\n  runs: 1\n  scenarios: " +
          scenarios + '\n',
      "study.yaml");
}

TEST(ExperimentFile, HasTheDocumentedDefaults) {
  const Experiment experiment = experiment_from_yaml(YamlDocument::parse(
      "{name: a, fit: {scenarios: [a.yaml]}, test: {scenarios: [a.yaml]}}", "a.yaml"));
  const auto compared = tests::compared_defaults(experiment_keys(), to_yaml(experiment));
  EXPECT_THAT(compared.different, ElementsAre("highlights", "video.estimators"))
      << "described in words, as they depend on other keys";
  EXPECT_GT(compared.equal, 25U);
}

TEST(ExperimentFile, HasNoFiguresOfDropsByDefaultOrWhereTheyAreSwitchedOff) {
  for (const char* tail : {"", "detail: {drop: 3, enabled: false}\n"}) {
    const Experiment experiment = read(tail);
    EXPECT_FALSE(experiment.detail.has_value());
    EXPECT_THAT(to_yaml(experiment), Not(HasSubstr("detail")));
  }
}

TEST(ExperimentFile, TakesDefaultsForEmptySections) {
  const Experiment experiment =
      read("detail:\nvideo: {}\n", {"fit.runs=4", "fit.perturbed=true", "fit.tuning={trials: 2}"});
  ASSERT_TRUE(experiment.detail && experiment.tuning);
  EXPECT_THAT(experiment.detail->estimators,
              ElementsAre("robust", "measurement_only", "reference", "load_filter", "paper"));
  EXPECT_THAT(experiment.detail->noise,
              ElementsAre(noise::NoiseCell{0.25, 1.0}, noise::NoiseCell{1.0, 5.0}));
  EXPECT_EQ(experiment.detail->choice.drop, 0);
  EXPECT_EQ(experiment.video.estimators, experiment.estimators);
  EXPECT_EQ(experiment.video.noise, experiment.highlights.front());
  EXPECT_EQ(experiment.video.noise.torque, 0.0);  // the first cell of the grid
  EXPECT_TRUE(experiment.tuning->fixed.empty());
  EXPECT_EQ(to_yaml(read_again(experiment)), to_yaml(experiment));
}

/// The user's own estimators come after the known ones, up to six.
TEST(ExperimentFile, ShowsTheUsersEstimatorsOfADropUpToSix) {
  EXPECT_THAT(read("detail: {}\n", {"estimators=[free_fall, load_filter, upkie_observer, robust]"})
                  .detail->estimators,
              ElementsAre("robust", "load_filter", "free_fall", "upkie_observer"));
  EXPECT_THAT(
      read("detail: {}\n", {"estimators=[oracle, nmn, free_fall, upkie_observer, "
                            "load_filter, measurement_only, robust]"})
          .detail->estimators,
      ElementsAre("robust", "measurement_only", "load_filter", "oracle", "nmn", "free_fall"));
}

TEST(ExperimentFile, ReadsFiguresOfDropsBackUnchanged) {
  const Experiment first = read(
      "detail: {run: 3, wheels: right, drop: 2, seed: 1, before: 0.2, after: 0.3,\n"
      "         noise: [{torque: 2, accelerometer: 0}], estimators: [load_filter]}\n");
  const Experiment again = read_again(first);
  EXPECT_EQ(to_yaml(again), to_yaml(first));
  ASSERT_TRUE(again.detail.has_value());
  EXPECT_EQ(again.detail->choice.run, 3);
  EXPECT_EQ(again.detail->choice.seed, 1);
  EXPECT_EQ(again.detail->choice.wheels, DropWheels::right);
  EXPECT_EQ(again.detail->choice.at, std::nullopt);
  EXPECT_EQ(read_again(read("detail: {at: 2.5}\n")).detail->choice.at, 2.5);
  EXPECT_EQ(again.detail->choice.before, 0.2);
  EXPECT_EQ(again.detail->noise[0].wheel, 2.0);
  EXPECT_EQ(again.detail->noise[0].levels().joint_velocity, 0.5);
}

TEST(ExperimentFile, HasEncoderNoiseInEveryCell) {
  const Experiment experiment =
      read("highlights: [{torque: 1, accelerometer: 0}]\n",
           {"noise.joint_position=0.01", "noise.knee_wheel={knee: [0, 2], wheel: [0, 2]}"});
  for (const Experiment& e : {experiment, read_again(experiment)}) {
    std::vector<noise::NoiseCell> cells = noise::noise_cells(e.noise);
    cells.insert(cells.end(), e.highlights.begin(), e.highlights.end());
    ASSERT_GT(cells.size(), 5U);
    for (const noise::NoiseCell& cell : cells) {
      EXPECT_EQ(cell.levels().joint_position, 0.01);
      EXPECT_EQ(cell.levels().joint_velocity, 0.5);
    }
  }
}

/// The film's noise need not be on the grid, because nothing is scored at it.
TEST(ExperimentFile, FilmsAtANoiseOfItsOwnOrAtTheFirstHighlight) {
  const std::string highlight = "highlights: [{torque: 1, accelerometer: 5}]\n";
  const noise::NoiseCell of_highlight = read(highlight, {"noise.hips=true"}).video.noise;
  EXPECT_EQ(of_highlight.torque, 1.0);
  EXPECT_EQ(of_highlight.accelerometer, 5.0);
  EXPECT_EQ(of_highlight.hip, 1.0);  // as in every cell of this grid
  const Experiment own =
      read(highlight + "video: {estimators: [paper], noise: {torque: 0.25, accelerometer: 0.23}}\n",
           {"noise.hips=true"});
  EXPECT_THAT(own.video.estimators, ElementsAre("paper"));
  EXPECT_EQ(own.video.noise.torque, 0.25);
  EXPECT_EQ(own.video.noise.wheel, 0.25);
  EXPECT_EQ(own.video.noise.hip, 0.25);
  EXPECT_EQ(read_again(own).video.noise, own.video.noise);
  EXPECT_EQ(read_again(own).video.estimators, own.video.estimators);
}

TEST(ExperimentFile, HasDrawnScenariosBehindItsFiles) {
  const auto scenarios_of = [](const std::string& scenarios) {
    return experiment_from_yaml(document_with(scenarios)).test.scenarios;
  };
  EXPECT_THAT(scenarios_of("{files: [scenarios/flat.yaml], generate: {seed: 7, count: 3, families: "
                           "[kerbs, lifts]}}"),
              ElementsAre("scenarios/flat.yaml", "drawn:kerbs_7_000", "drawn:lifts_7_000",
                          "drawn:kerbs_7_001"));
  EXPECT_THAT(scenarios_of("[drawn:hops_2_010]"), ElementsAre("drawn:hops_2_010"));
  EXPECT_NO_THROW(require_files(document_with("[drawn:hops_2_010, scenarios/flat.yaml]")));
}

TEST(ExperimentFile, WritesDrawnScenariosByNameForTheSameRequest) {
  const auto drawn_with = [](int seed) {
    return experiment_from_yaml(
        document_with("{generate: {seed: " + std::to_string(seed) + ", count: 4}}"));
  };
  const Experiment again = read_again(drawn_with(7));
  EXPECT_EQ(again.test.scenarios, drawn_with(7).test.scenarios);
  EXPECT_EQ(request_of(again).id, request_of(drawn_with(7)).id);
  EXPECT_NE(request_of(drawn_with(8)).id, request_of(again).id);
}

}  // namespace
}  // namespace touchdown::experiments
