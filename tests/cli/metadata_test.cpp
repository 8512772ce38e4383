#include <algorithm>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "estimator/npz/load_estimator.hpp"
#include "estimator/npz/npz.hpp"
#include "logs/log/recording_file.hpp"
#include "logs/model_file.hpp"
#include "program.hpp"
#include "synthetic_log.hpp"

namespace touchdown::cli {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// A model that `fit` wrote, and its later uses.
class Metadata : public ::testing::Test {
 protected:
  Metadata() {
    log("a.mpack", test::synthetic_log(3.0));
    run("fit a.mpack -o m.npz --robot tall --grid 60 60");
  }

  void log(const std::string& name, const logs::Recording& recording) const {
    logs::write_recording(recording, folder_ / name);
  }

  std::string run(const std::string& arguments) const {
    const Ended ended = touchdown_program(arguments, folder_.path());
    EXPECT_EQ(ended.exit_code, 0) << ended.errors;
    return ended.output;
  }

  std::string complaint_about(const std::string& arguments) const {
    const Ended ended = touchdown_program(arguments, folder_.path());
    EXPECT_EQ(ended.exit_code, 2) << ended.errors;
    EXPECT_EQ(std::count(ended.errors.begin(), ended.errors.end(), '\n'), 1) << ended.errors;
    return ended.errors;
  }

  const ScratchFolder folder_;
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
                        metadata.fingerprint + "\n"));
}

TEST_F(Metadata, HoldsTheHyperparametersOfTheFit) {
  run("fit a.mpack -o other.npz --robot tall --grid 60 60 --set threshold=0.5");
  EXPECT_EQ(load_metadata(folder_ / "other.npz").configuration.at("threshold"), "0.5");
  EXPECT_EQ(load_metadata(folder_ / "m.npz").configuration.at("threshold"), "0.8");
  run("estimate a.mpack --model other.npz -o fitted_so.csv");
  run("estimate a.mpack --model m.npz --set threshold=0.5 -o run_so.csv");
  run("estimate a.mpack --model m.npz -o usual.csv");
  const std::string fitted_so = read_file(folder_ / "fitted_so.csv");
  EXPECT_EQ(fitted_so, read_file(folder_ / "run_so.csv"));
  EXPECT_NE(fitted_so, read_file(folder_ / "usual.csv"));
  EXPECT_THAT(complaint_about("estimate a.mpack --model m.npz --set thresold=0.5"),
              AllOf(HasSubstr("'robust' has no hyperparameter 'thresold'"),
                    HasSubstr("did you mean 'threshold'")));
  EXPECT_THAT(complaint_about("estimate a.mpack --model m.npz --set bandwidth_floor=0.01"),
              HasSubstr("'bandwidth_floor' is fixed by the fit: touchdown fit --set"));
  EXPECT_THAT(complaint_about("fit a.mpack -o x.npz --set thresold=0.5 --estimator robust"),
              HasSubstr("did you mean 'threshold'"));
  EXPECT_THAT(complaint_about("fit a.mpack -o x.npz --set threshold=half --estimator robust"),
              HasSubstr("threshold=half: expected name=number, as in leave_below=0.25"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "x.npz"));
}

TEST_F(Metadata, OfASimulatedLogNamesItsRobot) {
  logs::Recording simulated = test::synthetic_log(3.0);
  simulated.info.scenario_yaml = "name: x\nrobot: models/upkie_heavy.yaml\n";
  log("heavy.mpack", simulated);
  run("fit heavy.mpack -o heavy.npz");
  EXPECT_EQ(load_metadata(folder_ / "heavy.npz").robot, "upkie_heavy");
  run("estimate heavy.mpack --model heavy.npz");
  EXPECT_THAT(complaint_about("estimate heavy.mpack --model m.npz"),
              HasSubstr("m.npz: was fitted to the robot 'tall', not to 'upkie_heavy' (--transfer "
                        "uses it all the same)"));
}

TEST_F(Metadata, OfARobotsFileHasItsLegs) {
  const std::string robot = "--robot models/upkie_long_legs.yaml";
  run("fit a.mpack -o long.npz --estimator force_kinematics " + robot);
  const ModelMetadata metadata = load_metadata(folder_ / "long.npz");
  EXPECT_EQ(metadata.robot, "upkie_long_legs");
  EXPECT_EQ(metadata.configuration.at("geometry.upper_length"), "0.2352") << "1.4 times 0.168 m";

  const auto beliefs = [&](const std::string& flags) {
    run("estimate a.mpack --model long.npz -o beliefs.csv " + flags);
    return read_file(folder_ / "beliefs.csv");
  };
  const std::string expected = beliefs("");
  EXPECT_EQ(beliefs(robot), expected);
  EXPECT_EQ(beliefs("--robot upkie --transfer"), expected) << "a name does not specify legs";
  EXPECT_NE(beliefs("--robot models/upkie.xml --transfer"), expected);
  EXPECT_THAT(complaint_about("estimate a.mpack --model long.npz --robot models/upkie.xml"),
              HasSubstr("was fitted to the robot 'upkie_long_legs', not to 'upkie' (--transfer"));
  for (const char* verb : {"estimate a.mpack --model long.npz", "fit a.mpack -o x.npz"}) {
    EXPECT_THAT(
        complaint_about(std::string(verb) + " --robot models/upkie_hevy.yaml"),
        AllOf(HasSubstr("models/upkie_hevy.yaml: no such file"), HasSubstr("upkie_heavy.yaml'?")));
  }
}

TEST_F(Metadata, OfASimulatedLogsRobotHasTheLegsOfItsFile) {
  for (const std::string robot : {"upkie_heavy", "upkie_long_legs"}) {
    const std::string file = "models/" + robot + ".yaml";
    logs::Recording simulated = logs::read_recording(folder_ / "a.mpack");
    simulated.info.scenario_yaml = "name: x\nrobot: " + file + "\n";
    log("own.mpack", simulated);
    const auto beliefs = [&](const std::string& flags) {
      run("estimate own.mpack -o beliefs.csv " + flags);
      return read_file(folder_ / "beliefs.csv");
    };
    for (const std::string flags : {"--estimator support_force", "--transfer"}) {
      const std::string own = beliefs(flags);
      EXPECT_EQ(beliefs(fmt::format("{} --robot {}", flags, file)), own) << robot;
      EXPECT_NE(beliefs(flags + " --robot models/upkie.xml"), own) << robot;
    }
    run("fit own.mpack -o own.npz --estimator force_kinematics");
    const std::string model = read_file(folder_ / "own.npz");
    run("fit own.mpack -o named.npz --estimator force_kinematics --robot " + file);
    EXPECT_EQ(read_file(folder_ / "named.npz"), model);
    EXPECT_EQ(load_metadata(folder_ / "own.npz").robot, robot);
  }
}

TEST_F(Metadata, OfAModelExportedForAnotherRobotHasItsLegs) {
  const std::string shipped = "models/evidence_curves.npz";
  EXPECT_THAT(run("export " + shipped + " --robot models/upkie_long_legs.yaml -o long.npz"),
              AllOf(HasSubstr("model     long.npz, for 'evidence_curves' at 1000 Hz on "
                              "'upkie_long_legs', fingerprint "),
                    HasSubstr("next      touchdown estimate LOG --model long.npz\n")));
  const auto beliefs = [&](const std::string& model_and_flags) {
    run("estimate a.mpack -o beliefs.csv --model " + model_and_flags);
    return read_file(folder_ / "beliefs.csv");
  };
  const std::string expected = beliefs("long.npz");
  EXPECT_EQ(expected, beliefs(shipped + " --robot models/upkie_long_legs.yaml --transfer"));
  EXPECT_NE(expected, beliefs(shipped));

  run("export long.npz --robot models/upkie.xml --set leave_below=0.25 -o quiet.npz");
  EXPECT_EQ(beliefs("quiet.npz"), beliefs(shipped + " --set leave_below=0.25"));
  run("export " + shipped + " --robot models/upkie_long_legs.yaml -o long.hpp");
  EXPECT_THAT(read_file(folder_ / "long.hpp"),
              HasSubstr(load_metadata(folder_ / "long.npz").fingerprint));

  EXPECT_THAT(complaint_about("export " + shipped + " --robot upkie_heavy -o x.npz"),
              HasSubstr("not to 'upkie_heavy'"));
  EXPECT_THAT(complaint_about("export m.npz --robot models/upkie.xml -o x.npz"),
              HasSubstr("m.npz: 'robust' uses no kinematics"));
  EXPECT_THAT(complaint_about("export " + shipped + " --set leave_bellow=0.25 -o x.npz"),
              HasSubstr("has no 'leave_bellow': expected one of"));
  EXPECT_THAT(complaint_about("export " + shipped + " --set leave_below -o x.npz"),
              HasSubstr("--set: leave_below: expected NAME=VALUE"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "x.npz"));
}

TEST_F(Metadata, OfAnotherEstimatorRateOrRobotIsAnError) {
  EXPECT_THAT(complaint_about("estimate a.mpack --model m.npz --estimator reference"),
              HasSubstr("m.npz: is a model of 'robust', which 'reference' cannot use (did you mean "
                        "--estimator robust?)"));
  EXPECT_THAT(complaint_about("estimate a.mpack --model m.npz --robot upkie"),
              HasSubstr("m.npz: was fitted to the robot 'tall', not to 'upkie'"));
  log("slow.mpack", test::synthetic_log(2.0, 5000));
  EXPECT_THAT(complaint_about("estimate slow.mpack --model m.npz"),
              HasSubstr("m.npz: was fitted at 1000 Hz, not at 200 Hz (--transfer"));
  EXPECT_THAT(run("estimate slow.mpack --model m.npz --robot upkie --transfer"),
              HasSubstr("at 200 Hz, Bayes filter (robust)"));
  EXPECT_THAT(run("estimate a.mpack --model m.npz --estimator measurement_only --robot tall"),
              HasSubstr("Measurement only"));
}

TEST_F(Metadata, ChoosesTheEstimatorThatAGridWasFittedFor) {
  run("fit a.mpack -o paper.npz --estimator paper --grid 60 60");
  EXPECT_THAT(run("estimate a.mpack --model paper.npz"), HasSubstr("Bayes filter (paper)"));
}

TEST_F(Metadata, IsNotNeededByOlderFiles) {
  ModelArrays arrays = read_npz(folder_ / "m.npz");
  arrays.erase("metadata");
  logs::write_npz(arrays, folder_ / "old.npz");
  EXPECT_THAT(run("estimate a.mpack --model old.npz --estimator reference"),
              HasSubstr("model        old.npz: has no metadata (an older or external file): "
                        "used with 'reference'\n"));
}

TEST_F(Metadata, DetectsAModelThatWasChangedAfterItsFit) {
  ModelArrays arrays = read_npz(folder_ / "m.npz");
  arrays["contact_likelihood"].data[100] += 1.0;
  logs::write_npz(arrays, folder_ / "m.npz");
  EXPECT_THAT(complaint_about("estimate a.mpack --model m.npz"),
              HasSubstr("m.npz: its numbers are not those that were fitted"));
}

TEST_F(Metadata, IsPartOfAModelExportedAsAHeader) {
  EXPECT_THAT(run("export m.npz -o out/my-model.hpp"),
              HasSubstr("touchdown::make_estimator(touchdown::compiled::my_model)"));
  EXPECT_THAT(
      read_file(folder_ / "out/my-model.hpp"),
      AllOf(HasSubstr("inline constexpr CompiledArray my_model[] = {"),
            HasSubstr(load_metadata(folder_ / "m.npz").fingerprint), Not(HasSubstr("P_contact"))));
  EXPECT_THAT(complaint_about("export m.npz -o m.txt"),
              HasSubstr("expected a header, FILE.hpp, or a model, FILE.npz"));
  EXPECT_THAT(complaint_about("export m.npz -o m.npz"),
              HasSubstr("m.npz: is the model itself: name another file"));
  EXPECT_THAT(complaint_about("export m.npz"), HasSubstr("either --benchmark DIR"));
  EXPECT_THAT(complaint_about("export a.mpack -o m.hpp"), HasSubstr("a.mpack: is not a readable"));
}

TEST_F(Metadata, OfAFolderIsAnError) {
  std::filesystem::create_directory(folder_ / "folder");
  EXPECT_THAT(complaint_about("estimate a.mpack --model folder"), HasSubstr("folder: is a folder"));
}

/// A regression: the summary once reported "all good" for such a log.
TEST_F(Metadata, AnImuThatIsUpsideDownIsReported) {
  logs::Recording robot = test::robot_log(2.0);
  for (models::Observation& o : robot.observation) {
    o.imu.raw_linear_acceleration = o.imu.linear_acceleration + Eigen::Vector3d(0.0, 0.0, 9.81);
  }
  log("good.mpack", robot);
  EXPECT_THAT(run("estimate good.mpack --estimator free_fall"),
              AllOf(HasSubstr("signals      all good"), Not(HasSubstr("contradicts gravity"))));
  for (models::Observation& o : robot.observation) {
    o.imu.orientation = Eigen::Quaterniond(0.0, 0.0, 0.0, 1.0);
  }
  log("turned.mpack", robot);
  EXPECT_THAT(run("estimate turned.mpack --estimator free_fall"),
              AllOf(HasSubstr(" invalid of 2000 steps"),
                    HasSubstr("steps the IMU's orientation contradicts gravity")));
}

}  // namespace
}  // namespace touchdown::cli
