
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "experiments/plan/request.hpp"
#include "experiments/studies/experiment_file.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::HasSubstr;

RunRequest request_with(const std::string& sensors) {
  YamlDocument document = YamlDocument::load(TOUCHDOWN_SOURCE_DIR "/experiments/stairs.yaml");
  if (!sensors.empty()) document.override_value("sensors=" + sensors);
  return request_of(experiment_from_yaml(document));
}

TEST(RequestedSensors, MakeTheSameRequestIfIdealAsNone) {
  const RunRequest none = request_with("");
  const RunRequest ideal = request_with("sensors/ideal.yaml");
  EXPECT_EQ(none.id, ideal.id);
  EXPECT_EQ(to_yaml(none.experiment), to_yaml(ideal.experiment));
  EXPECT_EQ(setup_caption(ideal.experiment), "");
}

TEST(RequestedSensors, CountByNameAndFileContent) {
  const ScratchFolder folder;
  const std::string mine = folder.write("mine.yaml", "torque: {white: 0.1}\n").string();
  const std::string first = request_with(mine).id;
  EXPECT_NE(first, request_with("").id);
  folder.write("mine.yaml", "torque: {white: 1e-1, delay: 0}  # in other words\n");
  EXPECT_EQ(request_with(mine).id, first);
  folder.write("mine.yaml", "torque: {white: 0.2}\n");
  EXPECT_NE(request_with(mine).id, first);
}

TEST(RequestedSensors, AreReadFromTheCopiesInTheRunDirectory) {
  const ScratchFolder folder;
  const std::string mine = folder.write("mine.yaml", "torque: {white: 0.1}\n").string();
  const RunRequest request = request_with(mine);
  const std::filesystem::path run = folder / "run";
  write_request(request, RunDirectory("stairs", request.id, run), false);
  folder.write("mine.yaml", "torque: {white: 0.2}\n");
  EXPECT_EQ(read_request(run).id, request.id);
  EXPECT_EQ(read_request(run).sensors.front().profile.torque[1].white, 0.1);
  folder.write("run/state/sensors_000.yaml", "torque: {white: 0.3}\n");
  EXPECT_THROW(read_request(run), InputError);
}

TEST(RequestedSensors, GiveARunTheSameErrorsInBothEngines) {
  RunRequest request = request_with("sensors/harsh.yaml");
  recordings::Recording first, again, other;
  for (recordings::Recording* recording : {&first, &again, &other}) {
    recording->observation.resize(20);
    recording->action.resize(20);
    for (models::Action& action : recording->action) action.servo[1].position = 0.5;
  }
  const noise::SensorProfile profile = request.sensors.front().profile;
  report_through_sensors(profile, request.experiment, 3, first);
  report_through_sensors(profile, request.experiment, 3, again);
  report_through_sensors(profile, request.experiment, 4, other);
  EXPECT_EQ(first.observation[7].servo[1].torque, again.observation[7].servo[1].torque);
  EXPECT_NE(first.observation[7].servo[1].torque, other.observation[7].servo[1].torque);
  EXPECT_NE(first.observation[7].servo[1].torque, 0.0);
  // The knee reports 0 rad plus the error of its zero, by which its target moves, too.
  EXPECT_EQ(first.action[7].servo[1].position, again.action[7].servo[1].position);
  EXPECT_NE(first.action[7].servo[1].position, other.action[7].servo[1].position);
  EXPECT_NE(first.action[7].servo[1].position, 0.5);
  EXPECT_EQ(setup_caption(request.experiment), "; sensors as in sensors/harsh.yaml");
  request.experiment.robot = "models/upkie_heavy.yaml";
  EXPECT_EQ(setup_caption(request.experiment),
            "; robot as in models/upkie_heavy.yaml; sensors as in sensors/harsh.yaml");
}

}  // namespace
}  // namespace touchdown::experiments
