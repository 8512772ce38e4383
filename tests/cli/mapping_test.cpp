#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "core/table.hpp"
#include "logs/log/recording_file.hpp"
#include "models/robot_model.hpp"
#include "program.hpp"

namespace touchdown::cli {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// Six columns, of joints in Upkie's order.
std::string six(const char* what) {
  return fmt::format("lh_{0}, lk_{0}, lw_{0}, rh_{0}, rk_{0}, rw_{0}", what);
}

/// The run as CSV in Upkie's units. Each number reads back to the same bits.
std::string si_csv(const logs::Recording& run) {
  std::string csv =
      fmt::format("t, {}, {}, {}, qw, qx, qy, qz, gx, gy, gz, ax, ay, az, px, py, pz\n", six("q"),
                  six("v"), six("tau"));
  for (const models::Observation& o : run.observation) {
    csv += fmt::format("{:.17g}", o.time);
    for (const auto& s : o.servo) csv += fmt::format(",{:.17g}", s.position);
    for (const auto& s : o.servo) csv += fmt::format(",{:.17g}", s.velocity);
    for (const auto& s : o.servo) csv += fmt::format(",{:.17g}", s.torque);
    const auto& q = o.imu.orientation;
    for (const double x : {q.w(), q.x(), q.y(), q.z()}) csv += fmt::format(",{:.17g}", x);
    for (const Eigen::Vector3d& v :
         {o.imu.angular_velocity, o.imu.linear_acceleration, o.imu.raw_linear_acceleration}) {
      csv += fmt::format(",{:.17g},{:.17g},{:.17g}", v.x(), v.y(), v.z());
    }
    csv += "\n";
  }
  return csv;
}

std::string si_mapping() {
  return fmt::format(R"(time: {{from: t}}
joints:
  position: {{from: [{}]}}
  velocity: {{from: [{}]}}
  torque: {{from: [{}]}}
imu:
  orientation: {{from: [qw, qx, qy, qz]}}
  angular_velocity: {{from: [gx, gy, gz]}}
  linear_acceleration: {{from: [ax, ay, az]}}
  proper_acceleration: {{from: [px, py, pz]}}
)",
                     six("q"), six("v"), six("tau"));
}

class Mapping : public InFolder {
 protected:
  Mapping() {
    write_tiny_experiment(folder_);
    folder_.output_of("simulate step.yaml --run 2 -o run.mpack");
    run_ = logs::read_recording(folder_ / "run.mpack");
    folder_.write("si.yaml", si_mapping());
    folder_.write("si.csv", si_csv(run_));
  }
  /// Output and messages of a command that succeeds.
  std::string ran(const std::string& arguments) const {
    const Ended ended = folder_.run(arguments);
    EXPECT_EQ(ended.exit_code, 0) << arguments << "\n" << ended.errors;
    return ended.output + ended.errors;
  }

  logs::Recording run_;
};

TEST_F(Mapping, LogInUpkiesUnitsGivesTheSameBeliefsAsTheRun) {
  EXPECT_THAT(ran("convert si.csv --mapping si.yaml -o si.mpack"),
              AllOf(HasSubstr(fmt::format("si.mpack, {} records", run_.steps())),
                    HasSubstr("touchdown estimate si.mpack"), Not(HasSubstr("lack"))));
  ran("fit run.mpack -o model.npz");
  ran("estimate run.mpack --model model.npz -o run.csv");
  ran("estimate si.mpack --model model.npz -o si_beliefs.csv");
  // The mapped log has no targets of joints, which loads use and this model does not. Behind them
  // is the stamp of each log's own clock.
  const auto without_loads = [&](const std::string& file) {
    std::istringstream lines(folder_.text(file));
    std::string all;
    for (std::string line; std::getline(lines, line);) {
      for (int column = 0; column < 5; ++column) line.resize(line.rfind(','));
      all += line + '\n';
    }
    return all;
  };
  EXPECT_EQ(without_loads("si_beliefs.csv"), without_loads("run.csv"));
}

TEST_F(Mapping, ExampleIsTheOneInTheDocuments) {
  const std::string example = TOUCHDOWN_SOURCE_DIR "/examples/mapping/robot";
  EXPECT_THAT(read_file(TOUCHDOWN_SOURCE_DIR "/docs/guides/map_a_log.md"),
              HasSubstr("```yaml\n" + read_file(example + ".yaml") + "```\n"));
  EXPECT_THAT(
      ran(fmt::format("convert {0}.csv --mapping {0}.yaml -o example.mpack --labels example.csv",
                      example)),
      AllOf(HasSubstr("10 records, from 81.000 to 81.009 s"), HasSubstr("3 intervals"),
            Not(HasSubstr("lack"))));
  const auto recorded = logs::read_recording(folder_ / "example.mpack");
  ASSERT_EQ(recorded.steps(), 10U);
  // The robot stands: knees bent backwards, torques that carry it, no gravity except for rounding.
  const models::Observation& o = recorded.observation.front();
  EXPECT_NEAR(o.servo[1].position, -45.3 * std::numbers::pi / 180.0, 1e-12);
  EXPECT_NEAR(o.servo[4].position, 45.2 * std::numbers::pi / 180.0, 1e-12);
  EXPECT_NEAR(o.servo[1].torque, 1.31, 1e-12);
  EXPECT_NEAR(o.servo[5].velocity, -10.0, 0.01);
  EXPECT_LT(o.imu.linear_acceleration.norm(), 0.1);
  EXPECT_NEAR(o.pitch, 0.0174, 1e-4);
}

/// A recording of closed legs as CSV: motors and wheels with the signs and zeros of the robot's
/// file, the IMU in Upkie's axes.
std::string csv_of_motors(const logs::Recording& run, const models::RobotModel& robot) {
  const std::size_t motors = run.observation[0].motor.size() / 2;
  std::string csv = "t,qw,qx,qy,qz,gx,gy,gz,px,py,pz";
  for (std::size_t i = 0; i < 2 * (motors + 1); ++i) csv += fmt::format(",q{0},v{0},tau{0}", i);
  for (const models::Observation& o : run.observation) {
    csv += fmt::format("\n{:.17g}", o.time);
    const auto& q = o.imu.orientation;
    for (const double x : {q.w(), q.x(), q.y(), q.z()}) csv += fmt::format(",{:.17g}", x);
    for (const Eigen::Vector3d& v : {o.imu.angular_velocity, o.imu.raw_linear_acceleration}) {
      csv += fmt::format(",{:.17g},{:.17g},{:.17g}", v.x(), v.y(), v.z());
    }
    for (std::size_t leg = 0; leg < 2; ++leg) {
      for (std::size_t i = 0; i <= motors; ++i) {
        const models::ServoReading& r =
            i < motors ? o.motor[motors * leg + i] : o.servo[3 * leg + 2];
        const std::size_t servo = 3 * leg + (i < motors ? i : 2);
        const bool is_own = robot.motor_joint[servo] == robot.joint[servo];
        const double sign = is_own && robot.is_reversed[servo] ? -1.0 : 1.0;
        csv += fmt::format(",{:.17g},{:.17g},{:.17g}",
                           sign * (r.position - (is_own ? robot.zero[servo] : 0.0)),
                           sign * r.velocity, sign * r.torque);
      }
    }
  }
  return csv + "\n";
}

TEST_F(InFolder, TurnsTheMotorsOfClosedLegsIntoHipsAndKnees) {
  for (const char* name : {"five_bar", "four_bar"}) {
    const std::string file = fmt::format(TOUCHDOWN_SOURCE_DIR "/models/{}.yaml", name);
    folder_.output_of(fmt::format(
        "simulate scenarios/one_step.yaml --set robot={} --set end.duration=1.5 -o run.mpack",
        file));
    const logs::Recording run = logs::read_recording(folder_ / "run.mpack");
    const auto robot = models::compile_robot_model(file, models::Terrain{});
    folder_.write("log.csv", csv_of_motors(run, robot));
    const std::size_t joints = run.observation[0].motor.size() + 2;
    const auto list = [&](const char* what) {
      std::string all;
      for (std::size_t i = 0; i < joints; ++i) all += fmt::format("{}{}{}", i ? ", " : "", what, i);
      return all;
    };
    folder_.write(
        "log.yaml",
        fmt::format("time: {{from: t}}\njoints:\n  closed_legs: {}\n  position: {{from: "
                    "[{}]}}\n  velocity: {{from: [{}]}}\n  torque: {{from: [{}]}}\nimu:\n "
                    " orientation: {{from: [qw, qx, qy, qz]}}\n  angular_velocity: {{from: "
                    "[gx, gy, gz]}}\n  proper_acceleration: {{from: [px, py, pz]}}\n",
                    file, list("q"), list("v"), list("tau")));
    folder_.output_of("convert log.csv --mapping log.yaml -o mapped.mpack");
    const logs::Recording mapped = logs::read_recording(folder_ / "mapped.mpack");
    ASSERT_EQ(mapped.steps(), run.steps()) << name;
    double largest = 0.0;
    for (std::size_t k = 1; k < run.steps(); ++k) {
      for (std::size_t i = 0; i < models::servo_count; ++i) {
        const models::ServoReading& is = mapped.observation[k].servo[i];
        const models::ServoReading& was = run.observation[k].servo[i];
        ASSERT_NEAR(is.position, was.position, 3e-3) << name << k << ", " << i;
        ASSERT_NEAR(is.torque, was.torque, 0.05 + 0.02 * std::abs(was.torque)) << name << k;
        largest = std::max(largest, std::abs(was.torque));
      }
      ASSERT_EQ(mapped.observation[k].motor.size(), joints - 2) << name;
    }
    EXPECT_GT(largest, 3.0) << name;
  }
}

TEST_F(Mapping, NoOutputReplacesASourceOfTheLog) {
  folder_.write("joined.yaml", "sources: {joints: si.csv, imu: imu.csv}\njoints: {}\n");
  folder_.write("imu.csv", "t,gx\n0,1\n");
  const std::string joints = folder_.text("si.csv");
  for (const std::string log : {".", "si.csv", "imu.csv"}) {
    for (const std::string source : {"si.csv", "imu.csv"}) {
      const std::string mapped = log + " --mapping joined.yaml ";
      const std::vector<std::string> named = {source + ": is the log itself"};
      folder_.expect_refusals({{"estimate " + mapped + "-o " + source, named},
                               {"estimate " + mapped + "--propose " + source, named},
                               {"convert " + mapped + "-o x.mpack --labels " + source, named}});
    }
  }
  EXPECT_EQ(folder_.text("si.csv"), joints);
  EXPECT_EQ(folder_.text("imu.csv"), "t,gx\n0,1\n");
}

TEST_F(Mapping, InconsistentRequestsAreRefusedAndNothingIsWritten) {
  folder_.write("bad.csv", "t,lh_q\n0,1\n");
  folder_.expect_refusals(
      {{"convert bad.csv --mapping si.yaml -o bad.mpack", {"si.yaml:3:20: "}},
       {"convert bad.csv --mapping si.yaml -o bad.csv",
        {"bad.csv: expected a log with the extension .mpack"}},
       {"convert bad.csv --mapping si.yaml --benchmark d", {"--mapping: expected -o"}},
       {"convert bad.csv --labels l.csv -o bad.mpack", {"--labels: expected --mapping"}},
       {"convert bad.csv -o bad.mpack", {"bad.mpack: expected --mapping"}},
       {"estimate bad.csv", {"bad.csv: is a CSV file, expected a log in Upkie's layout"}},
       {"convert bad.csv --mapping none.yaml -o bad.mpack", {"none.yaml"}},
       {"convert si.csv --mapping si.yaml -o bad.mpack --labels bad_labels.csv",
        {"--labels: si.csv has no contact labels"}},
       {"convert si.csv --mapping si.yaml -o bad.mpack --labels si.csv", {"si.csv"}}});
  EXPECT_FALSE(folder_.has("bad.mpack"));
  EXPECT_FALSE(folder_.has("bad_labels.csv"));
}

}  // namespace
}  // namespace touchdown::cli
