#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "logs/log/recording_file.hpp"
#include "program.hpp"
#include "tests/bag_writer.hpp"

namespace touchdown::cli {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// The robot's joints in the order of its driver, by their index in Upkie's order.
constexpr std::array<std::pair<const char*, std::size_t>, 6> driver_joints = {
    {{"right_hip_joint", 3},
     {"left_hip_joint", 0},
     {"right_knee_joint", 4},
     {"left_knee_joint", 1},
     {"right_wheel_joint", 5},
     {"left_wheel_joint", 2}}};

const char* const bag_mapping = R"(sources: {joints: /joint_states, imu: /imu/data}
joints:
  names: [left_hip_joint, left_knee_joint, left_wheel_joint, right_hip_joint, right_knee_joint, right_wheel_joint]
  sign: [1, 1, 1, -1, -1, -1]
)";

/// A run of Upkie as another robot's bag: joints at 500 Hz in another order, the right leg counted
/// like the left one; the IMU at 200 Hz on a clock of its own, by REP 103 and 145.
test::TestBag other_robots_bag(const logs::Recording& run) {
  constexpr std::int64_t epoch = 1'732'540'000'000'000'000;
  test::TestBag bag{
      {{"/joint_states", "sensor_msgs/msg/JointState"}, {"/imu/data", "sensor_msgs/msg/Imu"}}, {}};
  const auto stamp = [&](std::size_t k) {
    return epoch + std::llround(1e9 * run.observation[k].time);
  };
  for (std::size_t k = 0; k < run.steps(); ++k) {
    const models::Observation& o = run.observation[k];
    if (k % 2 == 0) {
      test::TestJoints joints;
      for (const auto& [name, i] : driver_joints) {
        const double sign = i < 3 ? 1.0 : -1.0;
        joints.name.emplace_back(name);
        joints.position.push_back(sign * o.servo[i].position);
        joints.velocity.push_back(sign * o.servo[i].velocity);
        joints.effort.push_back(sign * o.servo[i].torque);
      }
      bag.messages.push_back({0, stamp(k) + 1'000'000, test::joint_state_cdr(stamp(k), joints)});
    }
    if (k % 5 == 0) {
      const auto& q = o.imu.orientation;
      const Eigen::Vector3d& g = o.imu.angular_velocity;
      const Eigen::Vector3d& a = o.imu.raw_linear_acceleration;
      // From back, left, down to forward, left, up; from a reference with z down to one with z up.
      const Eigen::Quaterniond up = Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0) * q *
                                    Eigen::Quaterniond(0.0, 0.0, 1.0, 0.0).conjugate();
      const std::int64_t measured = stamp(k) + 350'000;
      bag.messages.push_back({1, measured + 1'500'000,
                              test::imu_cdr(measured, {{up.x(), up.y(), up.z(), up.w()},
                                                       {-g.x(), g.y(), -g.z()},
                                                       {-a.x(), a.y(), -a.z()}})});
    }
  }
  return bag;
}

/// Balanced accuracy of the decisions in a table of beliefs against the run, both wheels together.
/// `offset` is the run's time at the table's time 0.
double balanced_accuracy(const std::filesystem::path& csv, const logs::Recording& run,
                         double offset) {
  std::istringstream lines(read_file(csv));
  std::string line;
  std::getline(lines, line);
  EXPECT_THAT(line, HasSubstr("time_s,p_contact_left,p_contact_right,contact_left,contact_right"));
  std::array<double, 2> right{};
  std::array<double, 2> all{};
  while (std::getline(lines, line)) {
    std::vector<double> cells;
    std::istringstream text(line);
    for (std::string cell; cells.size() < 5 && std::getline(text, cell, ',');) {
      cells.push_back(std::stod(cell));
    }
    if (cells.at(0) < 0.3) continue;
    const auto k = static_cast<std::size_t>(std::llround((cells[0] + offset) / run.period()));
    for (std::size_t wheel = 0; wheel < 2; ++wheel) {
      const std::size_t contact = run.truth.at(k).wheel_normal_force.at(wheel) > 1.0 ? 1 : 0;
      ++all.at(contact);
      if ((cells.at(3 + wheel) > 0.5) == (contact == 1)) ++right.at(contact);
    }
  }
  return 0.5 * (right[0] / all[0] + right[1] / all[1]);
}

/// One command from a bag to beliefs; they are nearly as good as those from the run's own log.
TEST(Bag, OfAnotherRobotGivesBeliefsAsGoodAsTheRunsOwnLog) {
  const ScratchFolder folder;
  const std::string scenario = TOUCHDOWN_SOURCE_DIR "/scenarios/hop.yaml";
  const std::string model = TOUCHDOWN_SOURCE_DIR "/models/evidence_curves.npz";
  ASSERT_EQ(touchdown_program("simulate " + scenario + " -o run.mpack", folder.path()).exit_code,
            0);
  const logs::Recording run = logs::read_recording(folder / "run.mpack");
  const test::TestBag bag = other_robots_bag(run);
  std::filesystem::create_directories(folder / "bag");
  std::ofstream(folder / "bag" / "bag_0.mcap", std::ios::binary)
      << test::mcap_bytes(bag, {"zstd", 1000});
  folder.write("robot.yaml", bag_mapping);
  const Ended own =
      touchdown_program("estimate run.mpack --model " + model + " -o own.csv", folder.path());
  ASSERT_EQ(own.exit_code, 0) << own.errors;
  const Ended ended = touchdown_program("estimate bag --mapping robot.yaml --transfer --model " +
                                            model + " -o bag.csv -o annotated.mpack",
                                        folder.path());
  ASSERT_EQ(ended.exit_code, 0) << ended.errors;
  EXPECT_THAT(ended.output, AllOf(HasSubstr("bag: "), HasSubstr("at 500 Hz")));
  EXPECT_THAT(ended.errors, HasSubstr("/imu/data: held at the rows of /joint_states"));
  const double of_own = balanced_accuracy(folder / "own.csv", run, 0.0);
  const double of_bag = balanced_accuracy(folder / "bag.csv", run, 0.002);
  RecordProperty("balanced_accuracy", fmt::format("own log {:.4f}, bag {:.4f}", of_own, of_bag));
  fmt::print("balanced accuracy: own log {:.4f}, bag {:.4f}\n", of_own, of_bag);
  EXPECT_GT(of_bag, of_own - 0.02);

  // In two steps, and from SQLite: the same log.
  test::write_db3(bag, folder / "bag.db3");
  ASSERT_EQ(
      touchdown_program("export bag --mapping robot.yaml -o a.mpack", folder.path()).exit_code, 0);
  ASSERT_EQ(
      touchdown_program("export bag.db3 --mapping robot.yaml -o b.mpack", folder.path()).exit_code,
      0);
  EXPECT_EQ(read_file(folder / "a.mpack"), read_file(folder / "b.mpack"));
  ASSERT_EQ(
      touchdown_program("estimate a.mpack --transfer --model " + model + " -o a.csv", folder.path())
          .exit_code,
      0);
  EXPECT_EQ(read_file(folder / "a.csv"), read_file(folder / "bag.csv"));
}

/// The same door as that of `estimate`: bags, CSV files and arrays by a mapping.
TEST(Bag, IsCheckedByAMapping) {
  const ScratchFolder folder;
  const std::string scenario = TOUCHDOWN_SOURCE_DIR "/scenarios/hop.yaml";
  ASSERT_EQ(touchdown_program("simulate " + scenario + " -o run.mpack", folder.path()).exit_code,
            0);
  const test::TestBag bag = other_robots_bag(logs::read_recording(folder / "run.mpack"));
  std::filesystem::create_directories(folder / "bag");
  test::write_db3(bag, folder / "bag" / "bag_0.db3");
  std::ofstream(folder / "bag.mcap", std::ios::binary) << test::mcap_bytes(bag);
  folder.write("right.yaml", bag_mapping);
  const auto edited = [](const std::string& from, const std::string& to) {
    const std::string mapping = bag_mapping;
    const std::size_t at = mapping.find(from);
    return fmt::format("{}{}{}", mapping.substr(0, at), to, mapping.substr(at + from.size()));
  };
  folder.write("signs.yaml", edited("[1, 1, 1, -1, -1, -1]", "1"));
  folder.write("reference.yaml",
               bag_mapping + std::string("imu: {orientation: {reference: z_down}}\n"));
  folder.write(
      "gravity.yaml",
      bag_mapping + std::string("imu: {linear_acceleration: {from: [linear_acceleration.x, "
                                "linear_acceleration.y, linear_acceleration.z]}}\n"));
  folder.write("unit.yaml", bag_mapping + std::string("  torque: {unit: mNm}\n"));
  for (const std::string log : {"bag", "bag.mcap", "bag/bag_0.db3"}) {
    const Ended ended =
        touchdown_program("check " + log + " --mapping right.yaml --strict", folder.path());
    EXPECT_EQ(ended.exit_code, 0) << ended.errors;
    EXPECT_THAT(ended.output,
                AllOf(HasSubstr(log + ": 3500 records at 500 Hz"), HasSubstr(": plausible\n")));
    EXPECT_THAT(ended.errors, HasSubstr("/imu/data: held at the rows of /joint_states"));
  }
  const auto finding = [&](const std::string& mapping) {
    const std::string arguments = "check bag --mapping " + mapping;
    const Ended ended = touchdown_program(arguments, folder.path());
    EXPECT_EQ(ended.exit_code, 0) << ended.errors;
    EXPECT_EQ(touchdown_program(arguments + " --strict", folder.path()).exit_code, 1);
    return ended.output;
  };
  EXPECT_THAT(finding("signs.yaml"), HasSubstr("wheels: turn in opposite directions"));
  EXPECT_THAT(finding("reference.yaml"), HasSubstr("gravity was removed by a wrong orientation"));
  EXPECT_THAT(finding("gravity.yaml"), HasSubstr("linear_acceleration: holds gravity"));
  EXPECT_THAT(finding("unit.yaml"), HasSubstr("torques in N·m mapped as mNm"));
  const Ended estimated = touchdown_program("estimate bag --mapping gravity.yaml", folder.path());
  EXPECT_EQ(estimated.exit_code, 0) << estimated.errors;
  EXPECT_THAT(estimated.output, HasSubstr("signals      not plausible: 1 finding, printed above"));
  EXPECT_THAT(touchdown_program("check - --mapping right.yaml", folder.path()).errors,
              HasSubstr("--mapping: expected a file or a bag, found standard input"));
  EXPECT_THAT(touchdown_program("check bag", folder.path()).errors, HasSubstr("--mapping"));
}

/// The code blocks of docs/tutorials/ros2_bag.md, by what they begin with.
std::vector<std::string> documented(const std::string& beginning) {
  std::vector<std::string> lines;
  std::istringstream page(read_file(TOUCHDOWN_SOURCE_DIR "/docs/tutorials/ros2_bag.md"));
  bool is_code = false;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("```")) is_code = !is_code;
    if (is_code && line.starts_with(beginning)) lines.push_back(line);
  }
  return lines;
}

/// Every line that the page prints is one of the commands that it gives.
TEST(Bag, OfThePagePrintsWhatThePagePrints) {
  const ScratchFolder folder;
  const std::string scenario = TOUCHDOWN_SOURCE_DIR "/scenarios/hop.yaml";
  ASSERT_EQ(touchdown_program("simulate " + scenario + " -o run.mpack", folder.path()).exit_code,
            0);
  std::filesystem::create_directories(folder / "bag");
  test::write_db3(other_robots_bag(logs::read_recording(folder / "run.mpack")),
                  folder / "bag" / "bag_0.db3");
  const std::string page = read_file(TOUCHDOWN_SOURCE_DIR "/docs/tutorials/ros2_bag.md");
  const std::size_t begin = page.find("```yaml\n") + 8;
  const std::string mapping = page.substr(begin, page.find("```", begin) - begin);
  folder.write("robot.yaml", mapping);
  const std::vector<std::string> commands = documented("touchdown ");
  ASSERT_EQ(commands.size(), 2U);
  std::string printed;
  for (const std::string& command : commands) {
    const Ended ended = touchdown_program(command.substr(command.find(' ') + 1), folder.path());
    EXPECT_EQ(ended.exit_code, 0) << command << ": " << ended.errors;
    printed += ended.errors + ended.output;
  }
  std::string signs = mapping;
  const std::size_t sign = signs.find("[1, 1, 1, -1");
  signs = fmt::format("{}1{}", signs.substr(0, sign), signs.substr(signs.find(']', sign) + 1));
  folder.write("signs.yaml", signs);
  printed += touchdown_program("check bag --mapping signs.yaml", folder.path()).output;
  std::size_t compared = 0;
  for (const std::string beginning :
       {"touchdown: ", "bag: ", "  wheels: ", "contact ", "left wheel ", "signals ", "beliefs "}) {
    for (const std::string& line : documented(beginning)) {
      EXPECT_THAT(printed, HasSubstr(line + "\n"));
      ++compared;
    }
  }
  EXPECT_EQ(compared, 9U);
  // The conversion for other commands.
  const Ended converted =
      touchdown_program("export bag --mapping robot.yaml -o robot.mpack", folder.path());
  EXPECT_EQ(converted.exit_code, 0) << converted.errors;
}

/// The messages of a bag as two CSV files, a message per row.
void write_csv_files(const logs::Recording& run, const ScratchFolder& folder) {
  std::filesystem::create_directories(folder / "csv");
  std::ofstream joints(folder / "csv" / "joint_states.csv");
  std::ofstream imu(folder / "csv" / "imu.csv");
  joints << "header.stamp.sec,header.stamp.nanosec";
  for (const char* field : {"name", "position", "velocity", "effort"}) {
    for (int i = 0; i < 6; ++i) joints << fmt::format(",{}[{}]", field, i);
  }
  joints << "\n";
  imu << "header.stamp.sec,header.stamp.nanosec,header.frame_id,orientation.x,orientation.y,"
         "orientation.z,orientation.w,angular_velocity.x,angular_velocity.y,angular_velocity.z,"
         "linear_acceleration.x,linear_acceleration.y,linear_acceleration.z\n";
  for (std::size_t k = 0; k < run.steps(); ++k) {
    const models::Observation& o = run.observation[k];
    const std::int64_t stamp = 1'732'540'000'000'000'000 + std::llround(1e9 * o.time);
    const auto at = [](std::int64_t ns) {
      return fmt::format("{},{}", ns / 1'000'000'000, ns % 1'000'000'000);
    };
    const auto list = [&](double models::ServoReading::*member) {
      for (const auto& [name, i] : driver_joints) {
        joints << fmt::format(",{}", (i < 3 ? 1.0 : -1.0) * (o.servo.at(i).*member));
      }
    };
    if (k % 2 == 0) {
      joints << at(stamp);
      for (const auto& [name, i] : driver_joints) joints << ',' << name;
      list(&models::ServoReading::position);
      list(&models::ServoReading::velocity);
      list(&models::ServoReading::torque);
      joints << "\n";
    }
    if (k % 5 != 0) continue;
    const Eigen::Quaterniond& q = o.imu.orientation;
    const Eigen::Vector3d& g = o.imu.angular_velocity;
    const Eigen::Vector3d& a = o.imu.raw_linear_acceleration;
    imu << fmt::format("{},imu_link,{},{},{},{},{},{},{},{},{},{}\n", at(stamp + 350'000), -q.y(),
                       -q.x(), q.w(), q.z(), -g.x(), g.y(), -g.z(), -a.x(), a.y(), -a.z());
  }
}

/// The mappings that ship read the same robot's bag and its CSV files.
TEST(Bag, AndCsvFilesAreReadByTheExamples) {
  const ScratchFolder folder;
  const std::string examples = TOUCHDOWN_SOURCE_DIR "/examples/mapping/";
  const std::string scenario = TOUCHDOWN_SOURCE_DIR "/scenarios/hop.yaml";
  ASSERT_EQ(touchdown_program("simulate " + scenario + " -o run.mpack", folder.path()).exit_code,
            0);
  const logs::Recording run = logs::read_recording(folder / "run.mpack");
  std::ofstream(folder / "bag.mcap", std::ios::binary) << test::mcap_bytes(other_robots_bag(run));
  write_csv_files(run, folder);
  std::vector<double> accuracy;
  for (const std::string& log : {"bag.mcap --mapping " + examples + "ros2_bag.yaml",
                                 "csv --mapping " + examples + "ros2_csv.yaml",
                                 "csv/joint_states.csv --mapping " + examples + "ros2_csv.yaml"}) {
    const Ended checked = touchdown_program("check " + log + " --strict", folder.path());
    EXPECT_EQ(checked.exit_code, 0) << checked.errors;
    EXPECT_THAT(checked.output, HasSubstr(": 3500 records at 500 Hz, up to 6.998 s: plausible"));
    EXPECT_THAT(checked.errors, HasSubstr("ages 2.7 ms (median) to 4.7 ms"));
    const Ended ended = touchdown_program("estimate " + log + " -o beliefs.csv", folder.path());
    EXPECT_EQ(ended.exit_code, 0) << ended.errors;
    accuracy.push_back(balanced_accuracy(folder / "beliefs.csv", run, 0.002));
  }
  EXPECT_NEAR(accuracy[1], accuracy[0], 1e-3);
  EXPECT_EQ(accuracy[2], accuracy[1]);
}

TEST(Bag, WhatIsWrongWithOneIsOneLine) {
  const ScratchFolder folder;
  folder.write("robot.yaml", bag_mapping);
  folder.write("old.bag", "#ROSBAG V2.0\n");
  const auto complaint = [&](const std::string& arguments) {
    const Ended ended = touchdown_program(arguments, folder.path());
    EXPECT_EQ(ended.exit_code, 2) << arguments;
    EXPECT_EQ(std::count(ended.errors.begin(), ended.errors.end(), '\n'), 1) << ended.errors;
    return ended.errors;
  };
  const std::string free_fall = " --mapping robot.yaml --estimator free_fall";
  EXPECT_THAT(complaint("estimate old.bag" + free_fall), HasSubstr("rosbags-convert"));
  EXPECT_THAT(complaint("export old.bag --mapping robot.yaml -o a.mpack"),
              HasSubstr("rosbags-convert"));
  for (const char* log : {"none.mcap", "none", "none.csv"}) {
    EXPECT_THAT(complaint(fmt::format("estimate {}{}", log, free_fall)),
                HasSubstr(fmt::format("{}: no such file", log)));
  }
  EXPECT_THAT(complaint("estimate -" + free_fall), HasSubstr("found standard input"));
  EXPECT_FALSE(std::filesystem::exists(folder / "a.mpack"));
}

}  // namespace
}  // namespace touchdown::cli
