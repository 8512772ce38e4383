#include "experiments/plan/request.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "experiments/config/experiment_yaml.hpp"
#include "experiments/config/yaml_kind.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::ThrowsMessage;

RunRequest shipped(const std::string& name) {
  return request_of(experiment_from_yaml(
      completed(YamlDocument::load(TOUCHDOWN_SOURCE_DIR "/experiments/" + name + ".yaml"),
                YamlKind::experiment)));
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

/// The shipped robot's path is another one there.
TEST(Request, IsTheSameInEveryWorkingDirectory) {
  const ScratchFolder folder;
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(TOUCHDOWN_SOURCE_DIR);
  const RunRequest request = shipped("tables");
  write_request(request, RunDirectory("tables", request.id, folder / "run"), false);
  for (const auto& elsewhere : {std::filesystem::path("/"), folder.path(), folder / "run"}) {
    std::filesystem::current_path(elsewhere);
    EXPECT_EQ(read_request(folder / "run").id, request.id) << elsewhere;
    EXPECT_EQ(shipped("tables").id, request.id) << elsewhere;
  }
  std::filesystem::current_path(before);
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
  other.labels.window += 0.001;
  folder.write("config.yaml", to_yaml(other));
  EXPECT_THAT([&] { read_request(folder.path()); },
              ThrowsMessage<InputError>(HasSubstr("expected " + request.id)));
}

/// The request of `stairs` with the robot of a folder, which has parts in two files.
RunRequest with_robot_in(const ScratchFolder& folder) {
  YamlDocument document = YamlDocument::load(TOUCHDOWN_SOURCE_DIR "/experiments/stairs.yaml");
  document.override_value("robot=" + (folder / "robot.yaml").string());
  document.override_value("estimators=[load_filter, nmn]");
  document.override_value("video.estimators=[load_filter, nmn]");
  return request_of(experiment_from_yaml(document));
}

TEST(Request, NamesTheFileThatWasChanged) {
  const ScratchFolder folder;
  std::string robot = read_file(TOUCHDOWN_SOURCE_DIR "/models/upkie.xml");
  const std::size_t begin = robot.find("<actuator>");
  const std::size_t end = robot.find("</actuator>") + 11;
  folder.write("motors.xml", "<mujoco>" + robot.substr(begin, end - begin) + "</mujoco>");
  folder.write("upkie.xml", robot.replace(begin, end - begin, "<include file=\"motors.xml\"/>"));
  folder.write("robot.yaml", "mjcf: upkie.xml\n");
  const RunRequest request = with_robot_in(folder);
  std::vector<std::string> files;
  for (const RequestInput& input : request.inputs) files.push_back(input.file);
  EXPECT_THAT(files, IsSupersetOf({EndsWith("/motors.xml"), EndsWith("models/nmn.npz"),
                                   EndsWith("scenarios/stairs.yaml")}));

  const std::filesystem::path run = folder / "run";
  write_request(request, RunDirectory("stairs", request.id, run), false);
  EXPECT_EQ(read_request(run).id, request.id);
  for (const auto& [name, more] :
       {std::pair{"motors.xml", "<!-- -->"}, std::pair{"upkie.xml", "\n"},
        std::pair{"robot.yaml", "mass: 1.1\n"}}) {
    const std::string content = read_file(folder / name);
    folder.write(name, content + more);
    const auto names_it = ThrowsMessage<InputError>(
        HasSubstr(fmt::format("{} was changed since: ", (folder / name).string())));
    EXPECT_THAT([&] { read_request(run); }, names_it);
    EXPECT_THAT([&] { require_place(with_robot_in(folder), run, false); }, names_it);
    folder.write(name, content);
  }
  EXPECT_EQ(with_robot_in(folder).id, request.id);
}

/// Of two robots with one file name, each scenario has its own.
TEST(Request, DistinguishesRobotsOfOneNameInOtherFolders) {
  const ScratchFolder folder;
  const std::string scenario = read_file(TOUCHDOWN_SOURCE_DIR "/scenarios/flat.yaml");
  const auto robot = [&](const char* name) { return "robot: " + (folder / name).string() + "\n"; };
  folder.write("a/bot.yaml", "mjcf: " TOUCHDOWN_SOURCE_DIR "/models/upkie.xml\nmass: 1.05\n");
  folder.write("b/bot.yaml", "mjcf: " TOUCHDOWN_SOURCE_DIR "/models/upkie.xml\nmass: 1.2\n");
  const auto id = [&](const char* of_last) {
    folder.write("1.yaml", scenario + robot("a/bot.yaml"));
    folder.write("2.yaml", scenario + robot("b/bot.yaml"));
    folder.write("3.yaml", scenario + robot(of_last));
    YamlDocument document = YamlDocument::load(TOUCHDOWN_SOURCE_DIR "/experiments/stairs.yaml");
    const auto path = [&](const char* name) { return (folder / name).string(); };
    document.override_value(
        fmt::format("test.scenarios=[{}, {}, {}]", path("1.yaml"), path("2.yaml"), path("3.yaml")));
    return request_of(experiment_from_yaml(document)).id;
  };
  EXPECT_NE(id("a/bot.yaml"), id("b/bot.yaml"));
  EXPECT_EQ(id("a/bot.yaml"), id("a/bot.yaml"));
}

RunRequest request_with(const std::string& sensors) {
  YamlDocument document = YamlDocument::load(TOUCHDOWN_SOURCE_DIR "/experiments/stairs.yaml");
  if (!sensors.empty()) document.override_value("sensors=" + sensors);
  return request_of(experiment_from_yaml(document));
}

TEST(RequestedSensors, MakeTheSameRequestIfIdealAsNone) {
  const RunRequest none = request_with("");
  const RunRequest ideal = request_with("noise/profiles/ideal.yaml");
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
  RunRequest request = request_with("noise/profiles/harsh.yaml");
  logs::Recording first, again, other;
  for (logs::Recording* recording : {&first, &again, &other}) {
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
  EXPECT_EQ(setup_caption(request.experiment), "; sensors as in noise/profiles/harsh.yaml");
  request.experiment.robot = "models/upkie_heavy.yaml";
  EXPECT_EQ(setup_caption(request.experiment),
            "; robot as in models/upkie_heavy.yaml; sensors as in noise/profiles/harsh.yaml");
}

}  // namespace
}  // namespace touchdown::experiments
