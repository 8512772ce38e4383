#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "estimator/npz/load_estimator.hpp"
#include "estimator/npz/npz.hpp"
#include "logs/log/recording_file.hpp"
#include "logs/model_file.hpp"
#include "models/robot_description.hpp"
#include "program.hpp"
#include "synthetic_log.hpp"

namespace touchdown::cli {
namespace {

using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// A model that `fit` wrote, and its later uses.
class Metadata : public InFolder {
 protected:
  Metadata() {
    log("a.mpack", test::synthetic_log(3.0));
    run("fit a.mpack -o m.npz --robot tall --grid 60 60");
  }

  void log(const std::string& name, const logs::Recording& recording) const {
    logs::write_recording(recording, folder_ / name);
  }

  std::string run(const std::string& arguments) const { return folder_.output_of(arguments); }
};

TEST_F(Metadata, NamesEstimatorRateAndRobotOfAModel) {
  const ModelMetadata metadata = load_metadata(folder_ / "m.npz");
  EXPECT_EQ(metadata.estimator, "robust");
  EXPECT_EQ(metadata.sample_rate, 1000.0);
  EXPECT_EQ(metadata.robot, "tall");
  EXPECT_EQ(metadata.configuration.at("transition.switch.offset"), "50");
  EXPECT_THAT(run("estimate a.mpack --model m.npz"),
              HasSubstr("model        m.npz: fitted for 'robust' at 1000 Hz to 'tall', "
                        "fingerprint " +
                        metadata.fingerprint +
                        "; it was fitted to this log, so that its score is no test\n"));
  logs::Recording other = test::synthetic_log(2.5);
  other.info.run = 7;
  log("b.mpack", other);
  EXPECT_THAT(run("estimate b.mpack --model m.npz"), Not(HasSubstr("is no test")));
}

TEST_F(Metadata, HoldsTheHyperparametersOfTheFit) {
  run("fit a.mpack -o other.npz --robot tall --grid 60 60 --set threshold=0.5");
  EXPECT_EQ(load_metadata(folder_ / "other.npz").configuration.at("threshold"), "0.5");
  EXPECT_EQ(load_metadata(folder_ / "m.npz").configuration.at("threshold"), "0.8");
  run("estimate a.mpack --model other.npz -o fitted_so.csv");
  run("estimate a.mpack --model m.npz --set threshold=0.5 -o run_so.csv");
  run("estimate a.mpack --model m.npz -o usual.csv");
  const std::string fitted_so = folder_.text("fitted_so.csv");
  EXPECT_EQ(fitted_so, folder_.text("run_so.csv"));
  EXPECT_NE(fitted_so, folder_.text("usual.csv"));
  folder_.expect_refusals(
      {{"estimate a.mpack --model m.npz --set thresold=0.5",
        {"'robust' has no hyperparameter 'thresold'", "did you mean 'threshold'"}},
       {"estimate a.mpack --model m.npz --set bandwidth_floor=0.01",
        {"'bandwidth_floor' is fixed by the fit: touchdown fit --set"}},
       {"fit a.mpack -o x.npz --set thresold=0.5 --estimator robust", {"did you mean 'threshold'"}},
       {"fit a.mpack -o x.npz --set threshold=half --estimator robust",
        {"threshold=half: expected name=number, as in "}}});
  EXPECT_FALSE(folder_.has("x.npz"));
}

TEST_F(Metadata, OfASimulatedLogNamesItsRobot) {
  logs::Recording simulated = test::synthetic_log(3.0);
  simulated.info.scenario_yaml = "name: x\nrobot: models/upkie_heavy.yaml\n";
  log("heavy.mpack", simulated);
  run("fit heavy.mpack -o heavy.npz");
  EXPECT_EQ(load_metadata(folder_ / "heavy.npz").robot, "upkie_heavy");
  run("estimate heavy.mpack --model heavy.npz");
  folder_.expect_refusals({{"estimate heavy.mpack --model m.npz",
                            {"m.npz: was fitted to the robot 'tall', not to 'upkie_heavy' "
                             "(--transfer uses it all the same; in Python, transfer=True)"}}});
}

TEST_F(Metadata, OfARobotsFileGivesItsLegsToTheLoadFilter) {
  log("robot.mpack", test::robot_log(1.0));
  const auto beliefs = [&](const std::string& flags) {
    run("estimate robot.mpack -o beliefs.csv " + flags);
    return folder_.text("beliefs.csv");
  };
  const std::string expected = beliefs("");
  EXPECT_EQ(beliefs("--robot tall"), expected) << "a name does not specify legs";
  EXPECT_EQ(beliefs("--robot models/upkie.xml"), expected);
  EXPECT_NE(beliefs("--robot models/upkie_long_legs.yaml"), expected);
  const std::vector<std::string> near = {"models/upkie_hevy.yaml: no such file",
                                         "upkie_heavy.yaml'?"};
  folder_.expect_refusals({{"estimate a.mpack --robot models/upkie_hevy.yaml", near},
                           {"fit a.mpack -o x.npz --robot models/upkie_hevy.yaml", near}});
}

TEST_F(Metadata, OfASimulatedLogsRobotHasTheLegsOfItsFile) {
  for (const std::string robot : {"upkie_heavy", "upkie_long_legs"}) {
    const std::string file = "models/" + robot + ".yaml";
    logs::Recording simulated = logs::read_recording(folder_ / "a.mpack");
    simulated.info.scenario_yaml = "name: x\nrobot: " + file + "\n";
    log("own.mpack", simulated);
    const auto beliefs = [&](const std::string& flags) {
      run("estimate own.mpack -o beliefs.csv " + flags);
      return folder_.text("beliefs.csv");
    };
    const std::string own = beliefs("");
    EXPECT_EQ(beliefs("--robot " + file), own) << robot;
    EXPECT_NE(beliefs("--robot models/upkie.xml"), own) << robot;
    const std::string fit = "fit own.mpack --grid 60 60 --no-accuracy ";
    run(fit + "-o own.npz");
    const std::string model = folder_.text("own.npz");
    run(fit + "-o named.npz --robot " + file);
    EXPECT_EQ(folder_.text("named.npz"), model);
    EXPECT_EQ(load_metadata(folder_ / "own.npz").robot, robot);
  }
}

TEST_F(Metadata, OfARecordingStatesWhetherItsRobotIsStillTheSame) {
  folder_.write("upkie.xml", read_file(TOUCHDOWN_SOURCE_DIR "/models/upkie.xml"));
  folder_.write("own.yaml", "mjcf: upkie.xml\nmass: 1.1\n");
  logs::Recording simulated = test::synthetic_log(3.0);
  simulated.info.scenario_yaml = "name: x\nrobot: own.yaml\n";
  log("old.mpack", simulated);  // of a program that recorded no digest
  simulated.info.robot_digest = models::robot_digest(folder_ / "own.yaml");
  log("own.mpack", simulated);
  const std::string changed = "own.yaml, or a file that this reads, was changed since";
  const std::string assumed =
      "the legs are assumed to be Upkie's, because its robot cannot be read";
  const std::vector<std::string> uses = {
      "estimate own.mpack", "check own.mpack",
      "fit own.mpack -o own.npz --estimator robust --grid 40 40"};
  const auto expect = [&](const auto& matcher) {
    for (const std::string& use : uses) EXPECT_THAT(folder_.run(use).errors, matcher) << use;
  };
  expect(Not(AnyOf(HasSubstr(changed), HasSubstr(assumed))));
  // The robot's file is found beside the log, from wherever the program runs.
  const ProgramFolder elsewhere;
  const std::string there = (folder_ / "own.mpack").string();
  for (const char* verb : {"estimate ", "check "}) {
    EXPECT_THAT(elsewhere.run(verb + there).errors, Not(HasSubstr(assumed))) << verb;
    // A log of a robot that it does not name has no file to find.
    const std::string mapped = fmt::format("{0}/robot.csv --mapping {0}/robot.yaml",
                                           TOUCHDOWN_SOURCE_DIR "/examples/mapping");
    EXPECT_THAT(elsewhere.run(verb + mapped).errors, Not(HasSubstr(assumed))) << verb;
  }
  for (const std::string file : {"upkie.xml", "own.yaml"}) {
    const std::string before = folder_.text(file);
    folder_.write(file, before + "\n");
    expect(HasSubstr("touchdown: own.mpack: its robot " + changed));
    EXPECT_THAT(folder_.run("estimate old.mpack").errors, Not(HasSubstr(changed)));
    EXPECT_THAT(folder_.run(uses[0] + " --robot own.yaml").errors, Not(HasSubstr(changed)));
    // What promises the same run does not show another.
    const std::string again = "simulate own.mpack -o again.mpack --set end.duration=0.1";
    folder_.expect_refusals({{again, {"own.mpack: its robot " + changed, "--set robot=own.yaml"}},
                             {"render own.mpack -o x.mp4", {"its robot " + changed}},
                             {"convert own.mpack -o x.mcap", {"its robot " + changed}}});
    EXPECT_EQ(folder_.run(again + " --set robot=own.yaml").exit_code, 0);
    EXPECT_EQ(folder_.run("simulate old.mpack -o x.mpack --set end.duration=0.1").exit_code, 0);
    folder_.write(file, before);
  }
  std::filesystem::remove(folder_ / "upkie.xml");
  expect(HasSubstr("touchdown: own.mpack: " + assumed));
  std::filesystem::remove(folder_ / "own.yaml");
  expect(HasSubstr("touchdown: own.mpack: " + assumed));
  EXPECT_THAT(folder_.run("check old.mpack").errors, HasSubstr(assumed));
}

TEST_F(Metadata, OfAModelExportedFromARobotsFileHasItsLegs) {
  const std::string robot = "convert models/upkie_long_legs.yaml ";
  EXPECT_THAT(run(robot + "-o long.npz"),
              HasSubstr("long.npz, for 'load_filter' at 1000 Hz on 'upkie_long_legs', "
                        "fingerprint "));
  const ModelMetadata metadata = load_metadata(folder_ / "long.npz");
  EXPECT_EQ(metadata.robot, "upkie_long_legs");
  EXPECT_EQ(metadata.configuration.at("geometry.upper_length"), "0.2352") << "1.4 times 0.168 m";
  run(robot + "-o long.hpp");
  EXPECT_THAT(folder_.text("long.hpp"), HasSubstr(metadata.fingerprint));
  run(robot + "--set leave_below=0.25 -o other.npz");
  EXPECT_EQ(load_metadata(folder_ / "other.npz").configuration.at("leave_below"), "0.25");

  folder_.expect_refusals(
      {{"estimate a.mpack --model models/nmn.npz", {"nmn.npz", "'nmn', which needs no --model"}},
       {"estimate a.mpack --model long.npz --estimator robust",
        {"long.npz: is a model of 'load_filter', which 'robust' cannot use"}},
       {"convert m.npz --robot upkie_heavy -o x.npz", {"not to 'upkie_heavy'"}},
       {"convert m.npz --robot models/upkie.xml -o x.npz", {"m.npz: 'robust' uses no kinematics"}},
       {robot + "--set leave_bellow=0.25 -o x.npz",
        {"has no 'leave_bellow' (did you mean 'leave_below'?)"}},
       {robot + "--set leave_below -o x.npz", {"--set: leave_below: expected NAME=VALUE"}}});
  EXPECT_FALSE(folder_.has("x.npz"));
}

TEST_F(Metadata, OfAnotherEstimatorRateOrRobotIsAnError) {
  log("slow.mpack", test::synthetic_log(2.0, 5000));
  std::filesystem::create_directory(folder_ / "folder");
  folder_.expect_refusals(
      {{"estimate a.mpack --model m.npz --estimator reference",
        {"m.npz: is a model of 'robust', which 'reference' cannot use (did you mean --estimator "
         "robust?)"}},
       {"estimate a.mpack --model m.npz --robot upkie",
        {"m.npz: was fitted to the robot 'tall', not to 'upkie'"}},
       {"estimate slow.mpack --model m.npz", {"m.npz: was fitted at 1000 Hz, not at 200 Hz"}},
       {"estimate slow.mpack --model m.npz --robot upkie --transfer",
        {"m.npz: was fitted at 1000 Hz, not at 200 Hz"}},
       {"estimate a.mpack --model folder", {"folder: is a folder"}}});
  EXPECT_THAT(run("estimate a.mpack --model m.npz --robot upkie --transfer"),
              HasSubstr("at 1000 Hz, Bayes filter (robust)"));
  EXPECT_THAT(run("estimate a.mpack --model m.npz --estimator measurement_only --robot tall"),
              HasSubstr("Measurement only"));
}

TEST_F(Metadata, ChoosesTheEstimatorThatAGridWasFittedFor) {
  run("fit a.mpack -o paper.npz --estimator paper --grid 60 60");
  EXPECT_THAT(run("estimate a.mpack --model paper.npz"), HasSubstr("Bayes filter (paper)"));
}

TEST_F(Metadata, IsNotNeededByOlderFilesAndDetectsChangesAfterTheFit) {
  ModelArrays arrays = read_npz(folder_ / "m.npz");
  arrays["contact_likelihood"].data[100] += 1.0;
  logs::write_npz(arrays, folder_ / "changed.npz");
  folder_.expect_refusals({{"estimate a.mpack --model changed.npz",
                            {"changed.npz: its numbers are not those that were fitted"}}});
  arrays.erase("metadata");
  logs::write_npz(arrays, folder_ / "old.npz");
  EXPECT_THAT(run("estimate a.mpack --model old.npz --estimator reference"),
              HasSubstr("model        old.npz: has no metadata (an older or external file): "
                        "used with 'reference'"));
}

TEST_F(Metadata, IsPartOfAModelExportedAsAHeader) {
  EXPECT_THAT(run("convert m.npz -o out/my-model.hpp"),
              HasSubstr("touchdown::make_estimator(touchdown::compiled::my_model)"));
  EXPECT_THAT(
      folder_.text("out/my-model.hpp"),
      AllOf(HasSubstr("inline constexpr CompiledArray my_model[] = {"),
            HasSubstr(load_metadata(folder_ / "m.npz").fingerprint), Not(HasSubstr("P_contact"))));
  folder_.expect_refusals(
      {{"convert m.npz -o m.txt", {"expected a header, FILE.hpp, or a model, FILE.npz"}},
       {"convert m.npz -o m.npz", {"m.npz: is the model itself: name another file"}},
       {"convert m.npz", {"either --benchmark DIR"}},
       {"convert a.mpack -o m.hpp", {"m.hpp: expected FILE.mcap"}}});
}

/// A regression: the summary once reported "all good" for such a log.
TEST_F(Metadata, AnImuThatIsUpsideDownIsReported) {
  logs::Recording robot = test::robot_log(2.0);
  for (models::Observation& o : robot.observation) {
    o.imu.raw_linear_acceleration = o.imu.linear_acceleration - Eigen::Vector3d(0.0, 0.0, 9.81);
  }
  log("good.mpack", robot);
  EXPECT_THAT(run("estimate good.mpack --estimator free_fall"),
              AllOf(HasSubstr("signals      all good"), Not(HasSubstr("contradicts gravity"))));
  for (models::Observation& o : robot.observation) {
    o.imu.orientation = Eigen::Quaterniond(0.0, 0.0, 1.0, 0.0);
  }
  log("turned.mpack", robot);
  EXPECT_THAT(run("estimate turned.mpack --estimator free_fall"),
              AllOf(HasSubstr(" invalid of 2000 steps"),
                    HasSubstr("steps the IMU's orientation contradicts gravity")));
}

}  // namespace
}  // namespace touchdown::cli
