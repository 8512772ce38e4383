#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

/// A run, `run.mpack`, and the other robot's bag of it: `bag.mcap`, and the folder `bag`.
class Bag : public InFolder {
 protected:
  Bag() {
    folder_.output_of("simulate " TOUCHDOWN_SOURCE_DIR "/scenarios/hop.yaml -o run.mpack");
    run_ = logs::read_recording(folder_ / "run.mpack");
    const test::TestBag bag = other_robots_bag(run_);
    std::filesystem::create_directories(folder_ / "bag");
    test::write_db3(bag, folder_ / "bag" / "bag_0.db3");
    std::ofstream(folder_ / "bag.mcap", std::ios::binary) << test::mcap_bytes(bag, {"zstd", 1000});
    folder_.write("robot.yaml", bag_mapping);
  }

  logs::Recording run_;
};

/// One command from a bag to beliefs; they are nearly as good as those from the run's own log.
TEST_F(Bag, OfAnotherRobotGivesBeliefsAsGoodAsTheRunsOwnLog) {
  folder_.output_of("estimate run.mpack -o own.csv");
  const Ended ended = folder_.run("estimate bag.mcap --mapping robot.yaml -o bag.csv -o x.mpack");
  ASSERT_EQ(ended.exit_code, 0) << ended.errors;
  EXPECT_THAT(ended.output, AllOf(HasSubstr("bag.mcap: "), HasSubstr("at 500 Hz")));
  EXPECT_THAT(ended.errors, HasSubstr("/imu/data: held at the rows of /joint_states"));
  const double of_own = balanced_accuracy(folder_ / "own.csv", run_, 0.0);
  const double of_bag = balanced_accuracy(folder_ / "bag.csv", run_, 0.002);
  fmt::print("balanced accuracy: own log {:.4f}, bag {:.4f}\n", of_own, of_bag);
  EXPECT_GT(of_bag, of_own - 0.02);

  // In two steps, and from SQLite: the same log.
  folder_.output_of("convert bag.mcap --mapping robot.yaml -o a.mpack");
  folder_.output_of("convert bag/bag_0.db3 --mapping robot.yaml -o b.mpack");
  EXPECT_EQ(folder_.text("a.mpack"), folder_.text("b.mpack"));
  folder_.output_of("estimate a.mpack -o a.csv");
  // Times of an exported log are seconds, which have no nanoseconds since 1970.
  const auto without_stamps = [&](const std::string& file) {
    return std::regex_replace(folder_.text(file), std::regex(",[0-9]+\n"), "\n");
  };
  EXPECT_EQ(without_stamps("a.csv"), without_stamps("bag.csv"));
}

TEST_F(Bag, IsLabelledByItsMappingAsItsExportedLogIs) {
  EXPECT_THAT(folder_.output_of("estimate bag.mcap --mapping robot.yaml --propose bag.csv"),
              AllOf(HasSubstr("touchdown watch bag.mcap --labels bag.csv --mapping robot.yaml\n"),
                    HasSubstr("touchdown estimate bag.mcap --labels bag.csv ")));
  folder_.output_of("convert bag.mcap --mapping robot.yaml -o log.mpack");
  folder_.output_of("estimate log.mpack --propose log.csv");
  EXPECT_EQ(folder_.text("log.csv"), folder_.text("bag.csv"));
  folder_.output_of("fit log.mpack --labels bag.csv -o model.npz --no-accuracy");
  folder_.expect_refusals({{"estimate log.mpack --mapping robot.yaml --propose x.csv",
                            {"log.mpack: a log in Upkie's layout needs no mapping"}}});
}

/// The same door as that of `estimate`: bags, CSV files and arrays by a mapping.
TEST_F(Bag, IsCheckedByAMapping) {
  for (const std::string log : {"bag", "bag.mcap", "bag/bag_0.db3"}) {
    const Ended ended = folder_.run("check " + log + " --mapping robot.yaml --strict");
    EXPECT_EQ(ended.exit_code, 0) << ended.errors;
    EXPECT_THAT(ended.output,
                AllOf(HasSubstr(log + ": 3500 records at 500 Hz"), HasSubstr(": plausible\n")));
    EXPECT_THAT(ended.errors, HasSubstr("/imu/data: held at the rows of /joint_states"));
  }
  const std::string mapping = bag_mapping;
  const std::string gravity =
      mapping +
      "imu: {linear_acceleration: {from: [linear_acceleration.x, linear_acceleration.y, "
      "linear_acceleration.z]}}\n";
  for (const auto& [wrong, finding] : std::map<std::string, std::string>{
           {mapping.substr(0, mapping.find("[1, 1, 1")) + "1\n",
            "wheels: turn in opposite directions"},
           {mapping + "imu: {orientation: {reference: z_down}}\n",
            "orientation: has the robot upside down"},
           {gravity, "linear_acceleration: holds gravity"},
           {mapping + "  torque: {unit: mNm}\n", "torques in N·m mapped as mNm"}}) {
    folder_.write("wrong.yaml", wrong);
    EXPECT_THAT(folder_.output_of("check bag --mapping wrong.yaml"), HasSubstr(finding));
    EXPECT_EQ(folder_.run("check bag --mapping wrong.yaml --strict").exit_code, 1);
  }
  folder_.write("gravity.yaml", gravity);
  EXPECT_THAT(folder_.output_of("estimate bag --mapping gravity.yaml"),
              HasSubstr("signals      not plausible: 1 finding, printed above"));
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
TEST_F(Bag, OfThePagePrintsWhatThePagePrints) {
  const std::string page = read_file(TOUCHDOWN_SOURCE_DIR "/docs/tutorials/ros2_bag.md");
  const std::size_t begin = page.find("```yaml\n") + 8;
  const std::string mapping = page.substr(begin, page.find("```", begin) - begin);
  folder_.write("robot.yaml", mapping);
  folder_.write("models/mine.yaml", "mjcf: " TOUCHDOWN_SOURCE_DIR "/models/upkie.xml\n");
  const std::vector<std::string> commands = documented("touchdown ");
  ASSERT_EQ(commands.size(), 2U);
  std::string printed;
  for (const std::string& command : commands) {
    const Ended ended = folder_.run(command.substr(command.find(' ') + 1));
    EXPECT_EQ(ended.exit_code, 0) << command << ": " << ended.errors;
    printed += ended.errors + ended.output;
  }
  std::size_t compared = 0;
  for (const std::string beginning :
       {"touchdown: ", "bag: ", "contact ", "left wheel ", "signals ", "beliefs "}) {
    for (const std::string& line : documented(beginning)) {
      EXPECT_THAT(printed, HasSubstr(line + "\n"));
      ++compared;
    }
  }
  EXPECT_EQ(compared, 7U);
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
TEST_F(Bag, AndCsvFilesAreReadByTheExamples) {
  const std::string examples = TOUCHDOWN_SOURCE_DIR "/examples/mapping/";
  write_csv_files(run_, folder_);
  std::vector<double> accuracy;
  for (const std::string& log : {"bag.mcap --mapping " + examples + "ros2_bag.yaml",
                                 "csv --mapping " + examples + "ros2_csv.yaml",
                                 "csv/joint_states.csv --mapping " + examples + "ros2_csv.yaml"}) {
    const Ended checked = folder_.run("check " + log + " --strict");
    EXPECT_EQ(checked.exit_code, 0) << checked.errors;
    EXPECT_THAT(checked.output, HasSubstr(": 3500 records at 500 Hz, up to 6.998 s: plausible"));
    EXPECT_THAT(checked.errors, HasSubstr("ages 2.7 ms (median) to 4.7 ms"));
    folder_.output_of("estimate " + log + " -o beliefs.csv");
    accuracy.push_back(balanced_accuracy(folder_ / "beliefs.csv", run_, 0.002));
  }
  EXPECT_NEAR(accuracy[1], accuracy[0], 1e-3);
  EXPECT_EQ(accuracy[2], accuracy[1]);
}

TEST_F(Bag, ThatIsMissingOrOfAnotherFormatIsRefusedInOneLine) {
  folder_.write("old.bag", "#ROSBAG V2.0\n");
  const std::string free_fall = " --mapping robot.yaml --estimator free_fall";
  folder_.expect_refusals({{"estimate old.bag" + free_fall, {"rosbags-convert"}},
                           {"convert old.bag --mapping robot.yaml -o a.mpack", {"rosbags-convert"}},
                           {"estimate none.mcap" + free_fall, {"none.mcap: no such file"}},
                           {"estimate none" + free_fall, {"none: no such file"}},
                           {"estimate none.csv" + free_fall, {"none.csv: no such file"}},
                           {"estimate -" + free_fall, {"found standard input"}},
                           {"check - --mapping robot.yaml",
                            {"--mapping: expected a file or a bag, found standard input"}},
                           {"check bag", {"--mapping"}}});
  EXPECT_FALSE(folder_.has("a.mpack"));
}

}  // namespace
}  // namespace touchdown::cli
