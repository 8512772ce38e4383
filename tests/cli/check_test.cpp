#include <cmath>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "estimator/npz/load_estimator.hpp"
#include "logs/log/recording_file.hpp"
#include "program.hpp"
#include "synthetic_log.hpp"
#include "tests/models/upkie.hpp"

namespace touchdown::cli {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

using Change = std::function<void(models::Observation& record, std::size_t k)>;

/// A simulated hop as a robot's log, changed record by record.
class RobotsLog : public InFolder {
 protected:
  RobotsLog() {
    folder_.output_of("simulate scenarios/hop.yaml -o hop.mpack");
    hop_ = logs::read_recording(folder_ / "hop.mpack");
    hop_.info = {};
    hop_.truth.clear();
  }

  void write(const std::string& name, const Change& change, std::size_t every = 1) {
    logs::Recording log = hop_;
    log.observation.clear();
    log.action.clear();
    for (std::size_t k = 0; k < hop_.steps(); k += every) {
      log.observation.push_back(hop_.observation[k]);
      log.action.push_back(hop_.action[k]);
      if (change) change(log.observation.back(), k);
    }
    log.info.control_period_us *= static_cast<std::int64_t>(every);
    logs::write_recording(log, folder_ / name);
  }

  Ended run(const std::string& arguments) const { return folder_.run(arguments); }

  logs::Recording hop_;
};

void negate_torques(models::Observation& o, std::size_t /*k*/) {
  for (models::ServoReading& servo : o.servo) servo.torque *= -1.0;
}
void silence_knees(models::Observation& o, std::size_t /*k*/) {
  o.servo[1].torque = o.servo[4].torque = 0.0;
}

void alternate_a_wheel(models::Observation& o, std::size_t k) {
  if (k > 3000 && k < 3200) o.servo[5].torque = k % 2 == 0 ? 1.7 : -1.7;
}

TEST_F(RobotsLog, IsPlausibleAsItIsAndEstimatedByTheLoadFilterByDefault) {
  write("robot.mpack", {});
  EXPECT_THAT(folder_.output_of("check robot.mpack --strict"),
              AllOf(HasSubstr("robot.mpack: 7001 records at 1000 Hz"), HasSubstr("plausible")));
  EXPECT_THAT(folder_.output_of("check robot.mpack --robot models/upkie.xml"),
              HasSubstr("plausible"));
  const std::string estimated = folder_.output_of("estimate robot.mpack --strict");
  EXPECT_THAT(estimated.substr(0, estimated.find('\n')),
              AllOf(HasSubstr("7001 steps, 7.001 s at 1000 Hz"), HasSubstr("Load filter")));
  EXPECT_EQ(estimated, folder_.output_of("estimate robot.mpack --estimator load_filter"));
  for (const int every : {2, 4, 5, 10}) {
    write("slow.mpack", {}, static_cast<std::size_t>(every));
    EXPECT_THAT(folder_.output_of("estimate slow.mpack"),
                HasSubstr(fmt::format("at {} Hz", 1000 / every)));
  }
}

TEST_F(RobotsLog, WithImplausibleSignalsIsNamedByEveryCommandWithItsResult) {
  for (const auto& [change, finding] :
       std::vector<std::pair<Change, const char*>>{{negate_torques, "torques have the other sign"},
                                                   {silence_knees, "torque is 0 throughout"},
                                                   {alternate_a_wheel, "a limit cycle"}}) {
    write("wrong.mpack", change);
    EXPECT_THAT(folder_.output_of("check wrong.mpack"),
                AllOf(HasSubstr("check it"), HasSubstr(finding)));
    EXPECT_EQ(run("check wrong.mpack --strict").exit_code, 1);
    const Ended estimated = run("estimate wrong.mpack");
    EXPECT_EQ(estimated.exit_code, 0);
    EXPECT_THAT(estimated.errors, HasSubstr(finding));
    EXPECT_THAT(estimated.output, StartsWith("wrong.mpack: 7001 steps"));
    const Ended strict = run("estimate wrong.mpack --strict -o beliefs.csv");
    EXPECT_EQ(strict.exit_code, 1);
    EXPECT_EQ(strict.output.substr(0, 20), estimated.output.substr(0, 20)) << "with its result";
    folder_.write("wrong.csv", "start,end,contact\n0,2,1\n3,4,0\n");
    EXPECT_THAT(folder_.messages_of("fit wrong.mpack --labels wrong.csv -o m.npz --estimator "
                                    "robust --bandwidth 0.1 0.1"),
                AllOf(HasSubstr("touchdown: wrong.mpack: "), HasSubstr(finding)));
  }
}

TEST_F(RobotsLog, WithoutAValidStepHasNoContactInformation) {
  const double nan = std::nan("");
  for (const Change& change : std::vector<Change>{
           [&](models::Observation&o, std::size_t) { o.imu.linear_acceleration.setConstant(nan); },
           [&](models::Observation&o, std::size_t) { o.imu.orientation.coeffs().setConstant(3.0); },
           [&](models::Observation&o, std::size_t) {
             for (models::ServoReading& servo : o.servo) servo.torque = nan;
           }}) {
    write("invalid.mpack", change);
    const Ended estimated = run("estimate invalid.mpack -o beliefs.csv");
    EXPECT_EQ(estimated.exit_code, 1);
    EXPECT_THAT(estimated.errors, HasSubstr("none of its 7001 steps has usable signals"));
    EXPECT_THAT(estimated.output, Not(HasSubstr("contact")));
    EXPECT_FALSE(folder_.has("beliefs.csv"));
  }
}

TEST_F(RobotsLog, CountsValidStepsOnlyAndNamesTheirNumber) {
  const double nan = std::nan("");
  write("half.mpack", [&](models::Observation& o, std::size_t k) {
    if (k >= 2000 && k < 5000) o.imu.linear_acceleration.setConstant(nan);
  });
  EXPECT_THAT(folder_.output_of("estimate half.mpack"),
              AllOf(HasSubstr("of 3701 valid steps"), HasSubstr("3000 invalid of 7001 steps")));
}

using LogThatStatesItsPeriod = InFolder;

TEST_F(LogThatStatesItsPeriod, IsRefusedByEveryReaderIfItsTimesAreNoSeconds) {
  for (const auto& [factor, unit] : std::vector<std::pair<double, std::string>>{
           {1e3, "milliseconds"}, {1e6, "microseconds"}, {1e9, "nanoseconds"}}) {
    logs::Recording log = test::synthetic_log(2.0);
    for (models::Observation& o : log.observation) o.time *= factor;
    logs::write_recording(log, folder_ / "stated.mpack");
    for (const std::string arguments :
         {"check stated.mpack", "fit stated.mpack -o out.npz", "estimate stated.mpack",
          "estimate stated.mpack -o out.csv", "estimate stated.mpack -o out.mpack",
          "estimate - --estimator free_fall <stated.mpack", "convert stated.mpack -o out.mcap",
          "render stated.mpack -o out.mp4",
          "fit --contact stated.mpack --no-contact stated.mpack.2 -o out.npz"}) {
      const Ended ended = folder_.run(arguments);
      EXPECT_EQ(ended.exit_code, 2) << arguments;
      EXPECT_THAT(ended.errors,
                  AllOf(HasSubstr("expected seconds: steps of"), HasSubstr("look like " + unit)))
          << arguments;
    }
    for (const char* const output : {"out.npz", "out.csv", "out.mpack", "out.mcap", "out.mp4"}) {
      EXPECT_FALSE(folder_.has(output)) << output;
    }
  }
}

using FittedLogs = InFolder;

TEST_F(FittedLogs, AreRefusedIfOneIsNamedTwiceOrTheirRatesDiffer) {
  logs::write_recording(test::one_class_log(2.0, true), folder_ / "a.mpack");
  std::filesystem::create_symlink("a.mpack", folder_ / "link.mpack");
  std::filesystem::create_hard_link(folder_ / "a.mpack", folder_ / "same.mpack");
  for (const std::string logs :
       {"--contact a.mpack --no-contact a.mpack", "--contact a.mpack --no-contact ./a.mpack",
        "--contact a.mpack --no-contact link.mpack", "--contact a.mpack --no-contact same.mpack",
        "--contact a.mpack a.mpack"}) {
    folder_.expect_refusals({{"fit -o m.npz " + logs, {"is named twice"}}});
  }
  const logs::Recording slow = test::one_class_log(2.0, false);
  for (const int every : {2, 5}) {
    logs::Recording part = slow;
    part.observation.clear();
    part.action.clear();
    for (std::size_t k = 0; k < slow.steps(); k += static_cast<std::size_t>(every)) {
      part.observation.push_back(slow.observation[k]);
      part.action.push_back(slow.action[k]);
    }
    part.info.control_period_us = 1000 * every;
    logs::write_recording(part, folder_ / "b.mpack");
    folder_.expect_refusals({{"fit --contact a.mpack --no-contact b.mpack -o m.npz",
                              {fmt::format("{} steps per second", 1000 / every)}}});
  }
}

TEST_F(FittedLogs, AreSkippedAtTheirBeginningAloneAndNotAtThatOfEachSegment) {
  logs::write_recording(test::robot_log(3.0), folder_ / "robot.mpack");
  // Flights of 0.2 s, with a gap around each.
  folder_.write("robot.csv",
                "start,end,contact\n0.3495,0.5495,1\n0.6195,0.7795,0\n0.9995,1.4995,1\n"
                "1.6195,1.7795,0\n2.6195,2.7795,0\n");
  const std::string fit = "fit robot.mpack -o m.npz --no-accuracy --labels ";
  EXPECT_THAT(folder_.output_of(fit + "robot.csv"),
              AllOf(HasSubstr("no contact   960 samples"), HasSubstr("1.180 s of 1 log")));
  folder_.write("early.csv", "start,end,contact\n0.0,0.1995,0\n0.6195,0.7795,1\n");
  folder_.expect_refusals({{fit + "early.csv", {"no step of the logs is without contact"}}});
}

using CheckOfARobot = InFolder;

TEST_F(CheckOfARobot, PrintsWhatItReadAsTextOrJsonAndExitsWithZero) {
  folder_.write("robot.xml", edited_upkie({}));
  EXPECT_THAT(folder_.output_of("check robot.xml"),
              AllOf(HasSubstr("5.33922 kg"), HasSubstr("left_knee"), HasSubstr("-2.51 to 2.51"),
                    HasSubstr("mujoco: finished"), HasSubstr("bullet: finished"),
                    Not(HasSubstr("complaint"))));
  folder_.write("robot.yml", "# mine\nmjcf: robot.xml\nmass: 1.2\n");
  const auto json = nlohmann::json::parse(folder_.output_of("check robot.yml --json"));
  EXPECT_EQ(json["is_usable"], true);
  EXPECT_NEAR(json["mass_kg"].get<double>(), 1.2 * 5.33922, 1e-4);
  EXPECT_EQ(json["joints"].size(), 6U);
  EXPECT_EQ(json["joints"][3]["axis_in_base"], (std::vector<double>{0, 1, 0}));
  EXPECT_EQ(json["stands"].size(), 2U);
}

TEST_F(CheckOfARobot, PrintsItsComplaintsAndExitsWithOne) {
  folder_.write("robot.xml", edited_upkie({added("<tendon/>")}));
  const Ended ended = folder_.run("check robot.xml");
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.output, HasSubstr("complaint: robot.xml:149:1: tendon"));
}

TEST_F(InFolder, CheckWritesTheFileOfARobotAndDrawsIt) {
  const std::string five_bar = TOUCHDOWN_SOURCE_DIR "/models/legs/five_bar.xml";
  const Ended ended =
      folder_.run("check " + five_bar + " --write mine.yaml --figure mine.png --legs mine.npz");
  EXPECT_EQ(ended.exit_code, 0) << ended.errors;
  EXPECT_THAT(ended.output, AllOf(HasSubstr("gain margin"), HasSubstr("motor left_rear_motor")));
  EXPECT_THAT(folder_.text("mine.yaml"), HasSubstr("left_hip: left_front_motor"));
  EXPECT_GT(folder_.text("mine.png").size(), 10000U);
  EXPECT_EQ(load_closed_legs(folder_ / "mine.npz").legs()[1].linkage.motors.size(), 2U);
  EXPECT_EQ(folder_.run("check mine.yaml").exit_code, 0);
  folder_.expect_refusals(
      {{"check " + five_bar + " --write mine.yaml", {"mine.yaml: --write: exists already"}},
       {"check " + five_bar + " --write mine.xml", {"mine.xml: --write: expected a file with"}},
       {"check mine.yaml --write more.yaml", {"mine.yaml: --write: expected an MJCF or a URDF"}},
       {"check mine.yaml mine.yaml --figure a.png", {"--figure: expected one robot"}},
       {"check " + upkie_mjcf + " --legs legs.npz", {"--legs: expected a robot with closed legs"}},
       {"check log.mpack --legs legs.npz", {"--legs: expected one robot"}}});
}

TEST_F(CheckOfARobot, PrintsWarningsAndReadsNoSdf) {
  const std::string models = TOUCHDOWN_SOURCE_DIR "/models/";
  folder_.write("robot.urdf",
                edited(read_file(models + "legs/ros_style.urdf"),
                       {{"(<link name=\"left_shank\">)[\\s\\S]*?</inertial>", "$1"}}));
  folder_.write("robot.yaml",
                edited(read_file(models + "ros_style.yaml"), {{"legs/ros_style", "robot"}}));
  EXPECT_THAT(folder_.output_of("check robot.yaml"),
              HasSubstr("\nwarning: robot.urdf:35:3: mass of 1 link computed"));
  const auto json = nlohmann::json::parse(folder_.output_of("check robot.yaml --json"));
  EXPECT_EQ(json["warnings"].size(), 1U);
  folder_.write("robot.sdf", "<sdf version=\"1.9\"><model name=\"m\"/></sdf>");
  EXPECT_THAT(folder_.run("check robot.sdf").output, HasSubstr("robot.sdf:1:1: sdf: "));
}

TEST_F(InFolder, CheckNamesItsGuessesAndTheReasonAgainstARobot) {
  folder_.write("bare.xml", edited_upkie({{"<site name=\"imu\"[^>]*/>", ""}}));
  const Ended guessed = folder_.run("check bare.xml --write bare.yaml");
  EXPECT_THAT(guessed.errors, HasSubstr("bare.yaml: imu: torso  # a guess"));
  folder_.write("bad.xml", edited_upkie({added("<tendon><fixed name=\"rope\"/></tendon>")}));
  const Ended bad = folder_.run("check bad.xml --write bad.yaml");
  EXPECT_EQ(bad.exit_code, 1);
  EXPECT_THAT(bad.output, HasSubstr("complaint: bad.xml:149:9: tendon fixed 'rope'"));
}

}  // namespace
}  // namespace touchdown::cli
