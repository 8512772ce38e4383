#include "experiments/plan/request.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "experiments/studies/experiment_file.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

RunRequest shipped(const std::string& name) {
  return request_of(experiment_from_yaml(
      YamlDocument::load(TOUCHDOWN_SOURCE_DIR "/experiments/" + name + ".yaml")));
}

TEST(Request, ReadsBackUnchanged) {
  for (const char* name :
       {"stairs", "noise_study", "tables", "cross_simulator", "real_robot", "paper_course"}) {
    const ScratchFolder folder;
    const RunRequest request = shipped(name);
    const RunDirectory directory(name, request.id, folder.path());
    EXPECT_FALSE(is_written(request, folder.path()));
    write_request(request, directory, false);
    EXPECT_TRUE(is_written(request, folder.path()));
    EXPECT_EQ(read_request(folder.path()).id, request.id) << name;
  }
}

TEST(Request, ReplacesAnotherOneOnlyWithOverwrite) {
  const ScratchFolder folder;
  const RunRequest stairs = shipped("stairs");
  const RunRequest tables = shipped("tables");
  const RunDirectory directory("stairs", stairs.id, folder.path());
  write_request(stairs, directory, false);
  EXPECT_THAT(
      [&] { write_request(tables, directory, false); },
      ThrowsMessage<InputError>(HasSubstr("holds experiment 'stairs' (request " + stairs.id +
                                          "), and this is 'tables' (request " + tables.id + ")")));
  EXPECT_TRUE(is_written(stairs, folder.path()));
  write_request(tables, directory, true);
  EXPECT_EQ(read_request(folder.path()).id, tables.id);
}

TEST(Request, UsesItsRobotInEveryScenario) {
  RunRequest request = shipped("tables");
  const std::string own = request.id;
  Experiment experiment = request.experiment;
  experiment.robot = "models/upkie_heavy.yaml";
  request =
      request_of(experiment_from_yaml(YamlDocument::parse(to_yaml(experiment), "again.yaml")));
  EXPECT_NE(request.id, own);
  EXPECT_EQ(request.scenarios.size(), 3U);  // roam, hang, course
  for (const NamedScenario& named : request.scenarios) {
    EXPECT_THAT(named.scenario.robot, HasSubstr("upkie_heavy.yaml")) << named.file;
  }
  const ScratchFolder folder;
  write_request(request, RunDirectory("tables", request.id, folder.path()), false);
  EXPECT_EQ(read_request(folder.path()).id, request.id);
}

TEST(Request, IsRefusedAfterAChange) {
  const ScratchFolder folder;
  const RunRequest request = shipped("stairs");
  write_request(request, RunDirectory("stairs", request.id, folder.path()), false);
  Experiment other = request.experiment;
  other.labels.debounce += 0.001;
  folder.write("config.yaml", to_yaml(other));
  EXPECT_THAT([&] { read_request(folder.path()); },
              ThrowsMessage<InputError>(HasSubstr("expected " + request.id)));
}

}  // namespace
}  // namespace touchdown::experiments
