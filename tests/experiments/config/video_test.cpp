#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/studies/experiment_file.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

Experiment experiment_with(const std::string& more) {
  return experiment_from_yaml(YamlDocument::parse(
      "name: a\nestimators: [robust, phase, measurement_only]\nfit: {scenarios: [a.yaml]}\n"
      "test: {scenarios: [a.yaml]}\nnoise: {torque: [0.0, 1.0], accelerometer: [0.0, 5.0], "
      "hips: true}\n" +
          more,
      "a.yaml"));
}

TEST(VideoConfig, ShowsAllEstimatorsAtTheFirstHighlight) {
  const Experiment experiment =
      experiment_with("highlights: [{torque: 1, accelerometer: 5}, {torque: 0, accelerometer: 0}]");
  EXPECT_THAT(experiment.video.estimators, ElementsAre("robust", "phase", "measurement_only"));
  EXPECT_EQ(experiment.video.noise.torque, 1.0);
  EXPECT_EQ(experiment.video.noise.accelerometer, 5.0);
  EXPECT_EQ(experiment.video.noise.hip, 1.0);  // as in every cell of this grid
}

TEST(VideoConfig, WithoutHighlightsItsNoiseIsThatOfTheFirstCell) {
  const Experiment experiment = experiment_with("");
  EXPECT_EQ(experiment.video.noise, experiment.highlights.front());
  EXPECT_EQ(experiment.video.noise.torque, 0.0);
}

/// Its noise need not be on the grid, because nothing is scored at it.
TEST(VideoConfig, HasANoiseOfItsOwn) {
  const Experiment experiment = experiment_with(
      "highlights: [{torque: 1, accelerometer: 5}]\n"
      "video: {estimators: [phase], noise: {torque: 0.25, accelerometer: 0.23}}");
  EXPECT_THAT(experiment.video.estimators, ElementsAre("phase"));
  EXPECT_EQ(experiment.video.noise.torque, 0.25);
  EXPECT_EQ(experiment.video.noise.wheel, 0.25);
  EXPECT_EQ(experiment.video.noise.hip, 0.25);
  const Experiment again = experiment_from_yaml(YamlDocument::parse(to_yaml(experiment), "b.yaml"));
  EXPECT_EQ(again.video.noise, experiment.video.noise);
  EXPECT_EQ(again.video.estimators, experiment.video.estimators);
}

TEST(VideoConfig, BrokenKeysAreNamed) {
  for (const auto& [video, message] :
       {std::pair{"{torque_noise: 0.25}", "torque_noise: unknown key"},
        {"{noise: {torque: 0.25}}", "accelerometer"},
        {"{noise: {torque: -1, accelerometer: 0}}", "torque"},
        {"{noise: 3}", "noise"},
        {"{estimators: [free_fall]}", "free_fall"}}) {
    EXPECT_THAT([video = video] { experiment_with(std::string("video: ") + video); },
                ThrowsMessage<InputError>(HasSubstr(message)))
        << video;
  }
}

}  // namespace
}  // namespace touchdown::experiments
