#include <array>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "logs/bags/topic_rows.hpp"
#include "logs/log/reader.hpp"
#include "logs/mapping/conversion.hpp"
#include "logs/model_file.hpp"
#include "tests/bag_writer.hpp"
#include "tests/complaint.hpp"
#include "tests/logs/mapping/mapped_logs.hpp"

namespace touchdown::logs {
namespace {

namespace bags = touchdown::test;
namespace fs = std::filesystem;
using bags::TestBag;
using bags::TestImu;
using bags::TestJoints;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr std::int64_t epoch = 1'732'540'000'000'000'000;  // ns
constexpr std::int64_t ms = 1'000'000;

/// Joints in Upkie's order; the robot sends them in another one.
const std::vector<std::string> joint_names = {"l_hip", "l_knee", "l_wheel",
                                              "r_hip", "r_knee", "r_wheel"};
const std::array<std::size_t, 6> sent_order = {5, 2, 0, 4, 1, 3};

/// Signals of joint i at a time (s).
double position(std::size_t i, double t) { return std::sin(t + static_cast<double>(i)); }
double velocity(std::size_t i, double t) { return std::cos(t + static_cast<double>(i)); }
double torque(std::size_t i, double t) { return 0.1 * static_cast<double>(i) + t; }

TestJoints joints_at(double t, const std::vector<std::size_t>& which) {
  TestJoints joints;
  for (const std::size_t i : which) {
    joints.name.push_back(joint_names[i]);
    joints.position.push_back(position(i, t));
    joints.velocity.push_back(velocity(i, t));
    joints.effort.push_back(torque(i, t));
  }
  return joints;
}
const std::vector<std::size_t> all_joints(sent_order.begin(), sent_order.end());

/// An IMU with the time as its yaw rate, so that a row names the message that it got.
TestImu imu_at(double t) { return {.angular_velocity = {0.0, 0.0, t}}; }

std::int64_t stamp(double t) { return epoch + std::llround(1e9 * t); }

/// Joints at 500 Hz and an IMU at 200 Hz with a phase of its own. Messages arrive 3 and 8 ms late.
TestBag robot_bag(double seconds) {
  TestBag bag{{{"/joint_states", joint_state_type}, {"/imu", imu_type}, {"/other", "pkg/msg/X"}},
              {}};
  for (int k = 0; k < static_cast<int>(500 * seconds); ++k) {
    const double t = 0.002 * k;
    bag.messages.push_back(
        {0, stamp(t) + 3 * ms, bags::joint_state_cdr(stamp(t), joints_at(t, all_joints))});
  }
  for (int k = 0; k < static_cast<int>(200 * seconds); ++k) {
    const double t = 0.005 * k + 0.00035;
    bag.messages.push_back({1, stamp(t) + 8 * ms, bags::imu_cdr(stamp(t), imu_at(t))});
  }
  bag.messages.push_back({2, stamp(0.1), "anything"});
  std::stable_sort(bag.messages.begin(), bag.messages.end(),
                   [](const auto& a, const auto& b) { return a.time < b.time; });
  return bag;
}

const std::string bag_mapping =
    fmt::format("sources: {{joints: /joint_states, imu: /imu}}\njoints: {{names: [{}]}}\n",
                fmt::join(joint_names, ", "));

class JoinedLog : public test::MappedLogs {
 protected:
  fs::path write_bag(const TestBag& bag) const { return write("bag.mcap", bags::mcap_bytes(bag)); }

  /// Rows have the joints of their time, and the latest IMU message that was not measured later.
  void expect_joined(const std::vector<LogRow>& rows) {
    for (const LogRow& row : rows) {
      const double t = row.observation.time + start_ - 1e-9 * static_cast<double>(epoch);
      for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_NEAR(row.observation.servo[i].position, position(i, t), 1e-6);
        EXPECT_NEAR(row.observation.servo[i].velocity, velocity(i, t), 1e-6);
        EXPECT_NEAR(row.observation.servo[i].torque, torque(i, t), 1e-6);
      }
      // x forward, y left, z up to back, left, down: the yaw rate changes its sign.
      const double measured = -row.observation.imu.angular_velocity.z();
      const double latest = 0.005 * std::floor((t - 0.00035 + 1e-6) / 0.005) + 0.00035;
      EXPECT_NEAR(measured, latest, 1e-6) << t;
    }
  }
};

TEST_F(JoinedLog, TopicsOfABagAreJoinedAtTheJointsClock) {
  const TestBag bag = robot_bag(1.0);
  for (const std::string compression : {"", "zstd"}) {
    const auto rows = convert(write("bag.mcap", bags::mcap_bytes(bag, {compression})), bag_mapping);
    EXPECT_EQ(rows.size(), 499U);  // the first row is before the first IMU message
    EXPECT_EQ(converted_.incomplete_rows, 0U);
    expect_joined(rows);
    EXPECT_THAT(converted_.warnings,
                Contains(AllOf(HasSubstr("/imu: held at the rows of /joint_states"),
                               HasSubstr("ms (median)"))));
  }
  bags::write_db3(bag, folder_ / "bag.db3");
  const auto rows = convert(folder_ / "bag.db3", bag_mapping);
  EXPECT_EQ(rows.size(), 499U);
  expect_joined(rows);
}

TEST_F(JoinedLog, OfWhichFewRowsAreJoinedHasAFinding) {
  const auto findings = [&](double from, double to) {
    TestBag bag = robot_bag(2.0);
    std::erase_if(bag.messages, [&](const auto& message) {
      return message.topic == 1 && (message.time < stamp(from) || message.time > stamp(to));
    });
    const auto records = mapped_records(write_bag(bag), write("map.yaml", bag_mapping));
    while (records->next()) {
    }
    return records->notes().findings;
  };
  EXPECT_THAT(findings(0.0, 3.0), IsEmpty());
  EXPECT_THAT(findings(0.0, 1.5), IsEmpty());
  for (const auto& [from, to] :
       std::vector<std::pair<double, double>>{{0, .1}, {1.9, 3}, {1, 1.2}}) {
    EXPECT_THAT(findings(from, to), Contains(HasSubstr("/imu has values at "))) << from;
  }
}

TEST_F(JoinedLog, ReadingABagLeavesNoFileInTheTemporaryFolder) {
  const fs::path bag = write_bag(robot_bag(1.0));
  const fs::path map = write("map.yaml", bag_mapping);
  const ScratchFolder temporary;
  const TemporaryFilesIn there(temporary.path());
  LogReader reader(mapped_records(bag, map), "bag");
  std::size_t rows = 0;
  while (reader.next()) {
    if (++rows % 100 == 1) {
      EXPECT_TRUE(fs::is_empty(temporary.path())) << rows;
    }
  }
  EXPECT_TRUE(fs::is_empty(temporary.path()));
  EXPECT_EQ(rows, 499U);
}

TEST_F(JoinedLog, ReadingABagEndsWhenAsked) {
  const fs::path bag = write_bag(robot_bag(1.0));
  std::atomic<bool> stop = false;
  LogReader reader(mapped_records(bag, write("map.yaml", bag_mapping), {.stop = &stop}), "bag");
  ASSERT_TRUE(reader.next());
  stop = true;
  EXPECT_THROW(while (reader.next()){}, Stopped);
}

/// What messages may differ in: the order of joints, the byte order, the length of the frame's name
/// (the numbers behind it are aligned), joints of an arm, and which joints they have.
TEST_F(JoinedLog, MessagesMayDifferInOrderBytesAndFrames) {
  TestBag bag = robot_bag(0.5);
  int k = 0;
  for (auto& message : bag.messages) {
    const bool is_big = ++k % 3 == 0;
    const std::string frame(static_cast<std::size_t>(k % 11), 'f');
    const std::int64_t delay = (message.topic == 0 ? 3 : 8) * ms;
    const std::int64_t measured = message.time - delay;
    const double t = 1e-9 * static_cast<double>(measured - epoch);
    if (message.topic == 0) {
      std::vector<std::size_t> order = all_joints;
      std::rotate(order.begin(), order.begin() + k % 6, order.end());
      TestJoints joints = joints_at(t, order);
      for (const char* other : {"arm_1", "gripper"}) {
        const auto at = static_cast<std::ptrdiff_t>(k % 5);
        joints.name.insert(joints.name.begin() + at, other);
        for (auto* values : {&joints.position, &joints.velocity, &joints.effort}) {
          values->insert(values->begin() + at, -99.0);
        }
      }
      message.data = bags::joint_state_cdr(measured, joints, is_big, frame);
    } else if (message.topic == 1) {
      message.data = bags::imu_cdr(measured, imu_at(t), is_big, frame);
    }
  }
  bags::write_db3(bag, folder_ / "bag.db3", true);
  for (const fs::path& log : {write_bag(bag), folder_ / "bag.db3"}) {
    const auto rows = convert(log, bag_mapping);
    EXPECT_EQ(rows.size(), 249U);
    EXPECT_EQ(converted_.incomplete_rows, 0U);
    expect_joined(rows);
    EXPECT_EQ(converted_.warnings.size(), 2U)
        << fmt::format("{}", fmt::join(converted_.warnings, "; "));
  }
}

TEST_F(JoinedLog, ImuConventionsAreThoseOfRos) {
  TestBag bag = robot_bag(0.1);
  // Turned by 90 degrees about z (yaw), proper acceleration up.
  const TestImu imu{.orientation = {0.0, 0.0, std::sqrt(0.5), std::sqrt(0.5)},
                    .angular_velocity = {1.0, 2.0, 3.0},
                    .linear_acceleration = {0.5, 0.25, 9.81}};
  for (auto& message : bag.messages) {
    if (message.topic == 1) message.data = bags::imu_cdr(message.time - 8 * ms, imu);
  }
  const auto rows = convert(write_bag(bag), bag_mapping);
  ASSERT_FALSE(rows.empty());
  const auto& imu_read = rows.back().observation.imu;
  EXPECT_TRUE(imu_read.angular_velocity.isApprox(Eigen::Vector3d(-1.0, 2.0, -3.0)));
  EXPECT_TRUE(imu_read.raw_linear_acceleration.isApprox(Eigen::Vector3d(-0.5, 0.25, -9.81)));
  EXPECT_NEAR(imu_read.linear_acceleration.z(), 0.0, 0.01);  // without gravity
  EXPECT_NEAR(imu_read.linear_acceleration.x(), -0.5, 1e-9);
}

TEST_F(JoinedLog, WithoutSourcesTheOnlyTopicsAreTaken) {
  const std::string only_names =
      fmt::format("joints: {{names: [{}]}}\n", fmt::join(joint_names, ", "));
  const auto rows = convert(write_bag(robot_bag(0.5)), only_names);
  EXPECT_EQ(rows.size(), 249U);
  expect_joined(rows);
  TestBag two = robot_bag(0.1);
  two.topics.push_back({"/imu/raw", imu_type});
  two.messages.push_back({3, stamp(0.05), bags::imu_cdr(stamp(0.05), {})});
  EXPECT_THAT(
      complaint(write_bag(two), only_names),
      AllOf(HasSubstr("more than one topic of sensor_msgs/msg/Imu"), HasSubstr("/imu/raw")));
}

/// Each leg has a publisher, on one topic or on two, at times of its own.
TEST_F(JoinedLog, JointsOfSeveralPublishersAreHeld) {
  for (const bool is_one_topic : {true, false}) {
    TestBag bag{{{"/left", joint_state_type}, {"/imu", imu_type}, {"/right", joint_state_type}},
                {}};
    for (int k = 0; k < 200; ++k) {
      const double left = 0.002 * k;
      const double right = left + 0.0007;
      bag.messages.push_back({0, stamp(left) + 3 * ms,
                              bags::joint_state_cdr(stamp(left), joints_at(left, {2, 0, 1}))});
      bag.messages.push_back({is_one_topic ? 0U : 2U, stamp(right) + 3 * ms,
                              bags::joint_state_cdr(stamp(right), joints_at(right, {4, 3, 5}))});
      bag.messages.push_back({1, stamp(left) + 3 * ms, bags::imu_cdr(stamp(left), imu_at(left))});
    }
    std::stable_sort(bag.messages.begin(), bag.messages.end(),
                     [](const auto& a, const auto& b) { return a.time < b.time; });
    const std::string mapping =
        fmt::format("sources: {{joints: {}, imu: /imu}}\njoints: {{names: [{}]}}\n",
                    is_one_topic ? "/left" : "[/left, /right]", fmt::join(joint_names, ", "));
    const auto rows = convert(write_bag(bag), mapping);
    ASSERT_GE(rows.size(), 198U);
    const LogRow& last = rows.back();
    const double t = last.observation.time + start_ - 1e-9 * static_cast<double>(epoch);
    EXPECT_NEAR(t, 0.398, 1e-6);
    EXPECT_NEAR(last.observation.servo[0].position, position(0, t), 1e-6);
    EXPECT_NEAR(last.observation.servo[3].position, position(3, t - 0.0013), 1e-6);
    EXPECT_THAT(converted_.warnings, Contains(HasSubstr("1.3 ms")));
  }
}

TEST_F(JoinedLog, AnEffortThatLacksNowAndThenIsHeldAndThenMissing) {
  for (const bool is_empty : {true, false}) {
    TestBag bag = robot_bag(0.5);
    int k = 0;
    for (auto& message : bag.messages) {
      if (message.topic != 0) continue;
      const double t = 0.002 * k++;
      TestJoints joints = joints_at(t, all_joints);
      if (k % 5 == 0 || k > 150) {
        is_empty ? joints.effort.clear()
                 : joints.effort.assign(6, std::numeric_limits<double>::quiet_NaN());
      }
      message.data = bags::joint_state_cdr(stamp(t), joints);
    }
    const auto rows = convert(write_bag(bag), bag_mapping);
    ASSERT_EQ(rows.size(), 249U);
    EXPECT_NEAR(rows[18].observation.servo[1].torque, torque(1, 0.036), 1e-6);  // of 0.038 s
    EXPECT_NEAR(rows[18 + 5].observation.servo[1].position, position(1, 0.048), 1e-6);
    EXPECT_FALSE(std::isnan(rows[160].observation.servo[1].torque));  // 20 ms old
    EXPECT_TRUE(std::isnan(rows[200].observation.servo[1].torque));   // 100 ms old
    EXPECT_FALSE(std::isnan(rows[200].observation.servo[1].position));
  }
}

TEST_F(JoinedLog, AValueThatIsTooOldIsMissing) {
  TestBag bag = robot_bag(1.0);
  std::erase_if(bag.messages, [](const auto& message) {
    return message.topic == 1 && message.time > stamp(0.4) && message.time < stamp(0.7);
  });
  const auto rows = convert(write_bag(bag), bag_mapping);
  EXPECT_EQ(rows.size(), 499U);
  EXPECT_NEAR(static_cast<double>(converted_.incomplete_rows), 125.0, 3.0);  // 300 − 50 ms
  EXPECT_THAT(converted_.warnings,
              Contains(AllOf(HasSubstr("missing at 12"), HasSubstr("older than 50 ms"))));
  std::string longer = bag_mapping;
  longer.replace(longer.find("imu: /imu"), 9, "imu: /imu, stale_after: 1");
  (void)convert(folder_ / "bag.mcap", longer);
  EXPECT_EQ(converted_.incomplete_rows, 0U);
}

TEST_F(JoinedLog, MessagesWithoutStampsHaveTheTimeOfRecording) {
  TestBag bag = robot_bag(0.5);
  for (auto& message : bag.messages) {
    const double t = 1e-9 * static_cast<double>(message.time - epoch);
    if (message.topic == 0) message.data = bags::joint_state_cdr(0, joints_at(t, all_joints));
    if (message.topic == 1) message.data = bags::imu_cdr(0, imu_at(t));
  }
  const auto rows = convert(write_bag(bag), bag_mapping);
  EXPECT_GE(rows.size(), 240U);
  EXPECT_THAT(converted_.warnings, Contains(HasSubstr("times of recording")));
  EXPECT_NEAR(start_, 1e-9 * static_cast<double>(epoch), 0.1);
}

/// As programs write bags that merge others, or topic after topic.
TEST_F(JoinedLog, TheOrderOfMessagesInABagDoesNotMatter) {
  const TestBag bag = robot_bag(0.5);
  const auto rows = convert(write_bag(bag), bag_mapping);
  const std::vector<std::function<void(std::vector<bags::TestMessage>&)>> orders = {
      [](auto& m) { std::rotate(m.begin(), m.begin() + 20, m.end()); },
      [](auto& m) { std::reverse(m.begin(), m.end()); },
      [](auto& m) {
        std::stable_sort(m.begin(), m.end(),
                         [](const auto& a, const auto& b) { return a.topic < b.topic; });
      }};
  for (const auto& order : orders) {
    TestBag other = bag;
    order(other.messages);
    bags::write_db3(other, folder_ / "other.db3");
    for (const fs::path& log : {write_bag(other), folder_ / "other.db3"}) {
      const auto same = convert(log, bag_mapping);
      ASSERT_EQ(same.size(), rows.size());
      for (std::size_t k = 0; k < rows.size(); ++k) {
        EXPECT_EQ(same[k].observation.time, rows[k].observation.time);
        EXPECT_EQ(same[k].observation.servo[4].torque, rows[k].observation.servo[4].torque);
        EXPECT_EQ(same[k].observation.imu.angular_velocity,
                  rows[k].observation.imu.angular_velocity);
      }
    }
    fs::remove(folder_ / "other.db3");
  }
}

/// The clock of a simulation starts at zero, also behind a restart.
TEST_F(JoinedLog, AClockThatStartsAtZeroAgainIsFollowed) {
  TestBag bag{{{"/joint_states", joint_state_type}, {"/imu", imu_type}}, {}};
  for (int k = 0; k < 1000; ++k) {
    const double t = 0.002 * (k % 500);
    const std::int64_t recorded = epoch + 2 * ms * k;
    const std::int64_t simulated = 2 * ms * (k % 500);
    bag.messages.push_back({1, recorded, bags::imu_cdr(simulated, imu_at(t))});
    bag.messages.push_back(
        {0, recorded + 1, bags::joint_state_cdr(simulated, joints_at(t, all_joints))});
  }
  const auto rows = convert(write_bag(bag), bag_mapping);
  ASSERT_EQ(rows.size(), 1000U);
  EXPECT_EQ(converted_.start, 0.0);
  EXPECT_EQ(converted_.time_reversals, 1U);
  EXPECT_EQ(converted_.incomplete_rows, 0U);
  for (const LogRow& row : rows) {
    EXPECT_NEAR(-row.observation.imu.angular_velocity.z(), row.observation.time, 1e-9);
  }
}

/// A stamp that a publisher filled in wrongly.
TEST_F(JoinedLog, AMessageOfAWrongStampIsLeftOut) {
  for (const std::int64_t wrong : {-400 * ms, 3000 * ms}) {
    TestBag bag = robot_bag(1.0);
    for (const std::size_t topic : {0U, 1U}) {
      auto message = std::ranges::find_if(bag.messages, [&](const auto& one) {
        return one.topic == topic && one.time > stamp(0.5);
      });
      const std::int64_t measured = message->time - (topic == 0 ? 3 : 8) * ms;
      const double t = 1e-9 * static_cast<double>(measured - epoch);
      message->data = topic == 0 ? bags::joint_state_cdr(measured + wrong, joints_at(t, all_joints))
                                 : bags::imu_cdr(measured + wrong, imu_at(t));
    }
    EXPECT_EQ(convert(write_bag(bag), bag_mapping).size(), 498U);
    EXPECT_EQ(converted_.time_reversals, 0U);
    EXPECT_EQ(converted_.incomplete_rows, 0U);
    EXPECT_THAT(converted_.warnings, Contains(AllOf(HasSubstr("/joint_states: 1 of 500 messages"),
                                                    HasSubstr("contradict"))));
  }
}

TEST_F(JoinedLog, MalformedMessagesAreLeftOutAndCounted) {
  TestBag bag = robot_bag(0.5);
  bag.messages[100].data.resize(50);
  bag.messages[101].data.clear();
  bag.messages[102].data[1] = '\7';
  (void)convert(write_bag(bag), bag_mapping);
  EXPECT_THAT(converted_.warnings, Contains(HasSubstr("messages are left out, the first because")));
}

TEST_F(JoinedLog, WhatABagLacksIsNamed) {
  const TestBag whole = robot_bag(0.2);
  const auto with = [&](const std::function<void(TestJoints&, TestImu&)>& change) {
    TestBag bag = whole;
    for (auto& message : bag.messages) {
      TestJoints joints = joints_at(0.0, all_joints);
      TestImu imu;
      change(joints, imu);
      if (message.topic == 0) message.data = bags::joint_state_cdr(message.time, joints);
      if (message.topic == 1) message.data = bags::imu_cdr(message.time, imu);
    }
    return complaint(write_bag(bag), bag_mapping);
  };
  EXPECT_THAT(with([](TestJoints& joints, TestImu&) { joints.effort.clear(); }),
              HasSubstr("effort is not given by the messages of /joint_states"));
  EXPECT_THAT(with([](TestJoints& joints, TestImu&) { joints.velocity.clear(); }),
              HasSubstr("velocity is not given"));
  EXPECT_THAT(with([](TestJoints&, TestImu& imu) { imu.orientation_covariance = -1.0; }),
              AllOf(HasSubstr("orientation is not given by the messages of /imu"),
                    HasSubstr("imu_filter_madgwick")));
  EXPECT_THAT(with([](TestJoints&, TestImu& imu) { imu.orientation = {}; }),
              HasSubstr("orientation is not given"));
  EXPECT_THAT(with([](TestJoints& joints, TestImu&) { joints.name[2] = "left_hip"; }),
              HasSubstr("/joint_states has no column 'l_hip/position'"));
}

TEST_F(JoinedLog, WrongMappingsOfABagAreRefused) {
  const fs::path bag = write_bag(robot_bag(0.2));
  EXPECT_THAT(complaint(bag, "sources: {joints: /joint_states, imu: /imu}\njoints: {}\n"),
              AllOf(HasSubstr("'names' is missing"), HasSubstr("r_wheel, l_wheel")));
  EXPECT_THAT(complaint(bag, "sources: {joints: /imu, imu: /joint_states}\njoints: {}\n"),
              HasSubstr("has the type sensor_msgs/msg/Imu, expected sensor_msgs/msg/JointState"));
  EXPECT_THAT(complaint(bag, "sources: {stale_after: 0.1}\njoints: {}\n"),
              HasSubstr("map.yaml:1:10: sources: expected 'joints', 'imu', or both"));
  EXPECT_THAT(complaint(bag, "sources: {joints: joints.csv}\njoints: {}\n"),
              HasSubstr("map.yaml:1:10: sources.imu: is missing"));
  EXPECT_THAT(complaint(bag, "sources: {joints: /joint_states, imu: /imu, stale_after: -1}\n"),
              HasSubstr("sources.stale_after"));
  EXPECT_THAT(complaint(bag, "sources: {joints: joints.csv, imu: imu.csv}\n"),
              HasSubstr("give one of them, or their folder"));
  EXPECT_THAT(complaint(write("log.csv", "t\n0\n"), bag_mapping), HasSubstr("is no ROS 2 bag"));
  EXPECT_THAT(complaint(write("old.bag", "#ROSBAG V2.0\n"), bag_mapping),
              HasSubstr("rosbags-convert"));
}

TEST_F(JoinedLog, TopicsWithoutACommonTimeAreRefusedWithTheirTimes) {
  TestBag bag = robot_bag(0.2);
  for (auto& message : bag.messages) {  // an IMU that counts since it was switched on
    if (message.topic == 1) message.data = bags::imu_cdr(message.time - epoch + 60'000 * ms, {});
  }
  EXPECT_THAT(complaint(write_bag(bag), bag_mapping),
              AllOf(HasSubstr("/imu has 40 rows from 60.0"), HasSubstr("time: {from: log_time}")));
  const auto rows = convert(folder_ / "bag.mcap", bag_mapping + "time: {from: log_time}\n");
  EXPECT_GE(rows.size(), 95U);
}

/// Stamps of one robot are recorded about as late, whatever their topic; 5 ms differ here.
TEST_F(JoinedLog, AClockAheadOrBehindIsNamedByTheTimesOfRecording) {
  std::int64_t slip = 0;  // of the time of recording of one message
  const auto notes = [&](double ahead, const std::string& more = "") {
    TestBag bag = robot_bag(2.0);
    for (auto& message : bag.messages) {
      if (message.topic != 1) continue;
      const std::int64_t measured = message.time - 8 * ms;
      message.data = bags::imu_cdr(measured + std::llround(1e9 * ahead), {});
      message.time += std::exchange(slip, 0);
    }
    convert(write_bag(bag), bag_mapping + more);
    return fmt::format("{}", fmt::join(converted_.warnings, "\n"));
  };
  EXPECT_THAT(notes(0.5),
              HasSubstr("/imu: its stamps are 0.495 s ahead of those of /joint_states"));
  EXPECT_THAT(complaint_of([&] { (void)notes(1.0); }),
              HasSubstr("/imu: its stamps are 0.995 s ahead of those of /joint_states"));
  EXPECT_THAT(notes(0.2), HasSubstr("ahead of those of /joint_states"));
  EXPECT_THAT(notes(-0.2), HasSubstr("behind those of /joint_states"));
  for (const double small : {0.0, 0.012, -0.012}) {
    EXPECT_THAT(notes(small), ::testing::Not(HasSubstr("its stamps are"))) << small;
  }
  EXPECT_THAT(notes(0.2, "time: {from: log_time}\n"), ::testing::Not(HasSubstr("its stamps are")));
  for (const std::int64_t wrong : {-900 * ms, 900 * ms}) {
    slip = wrong;
    EXPECT_THAT(notes(0.0), ::testing::Not(HasSubstr("its stamps are")));
    slip = wrong;
    EXPECT_THAT(notes(0.5), HasSubstr("/imu: its stamps are 0.495 s ahead of"));
  }
}

// Files ------------------------------------------------------------------------------------------

struct Csv {
  std::string joints = "header.stamp.sec,header.stamp.nanosec";
  std::string imu =
      "header.stamp.sec,header.stamp.nanosec,"
      "qx,qy,qz,qw,gx,gy,gz,ax,ay,az\n";
};

std::string sec_nanosec(double t) {
  return fmt::format("{},{}", stamp(t) / 1'000'000'000, stamp(t) % 1'000'000'000);
}

/// The same robot as two files, as `ros2 topic echo --csv` and scripts write them.
Csv robot_csv(double seconds) {
  Csv csv;
  for (const char* field : {"position", "velocity", "effort"}) {
    for (const std::size_t i : sent_order)
      csv.joints += fmt::format(",{}/{}", joint_names[i], field);
  }
  csv.joints += "\n";
  for (int k = 0; k < static_cast<int>(500 * seconds); ++k) {
    const double t = 0.002 * k;
    csv.joints += sec_nanosec(t);
    for (const std::size_t i : sent_order) csv.joints += fmt::format(",{:.12g}", position(i, t));
    for (const std::size_t i : sent_order) csv.joints += fmt::format(",{:.12g}", velocity(i, t));
    for (const std::size_t i : sent_order) csv.joints += fmt::format(",{:.12g}", torque(i, t));
    csv.joints += "\n";
  }
  for (int k = 0; k < static_cast<int>(200 * seconds); ++k) {
    const double t = 0.005 * k + 0.00035;
    csv.imu += fmt::format("{},0,0,0,1,0,0,{:.12g},0,0,9.81\n", sec_nanosec(t), t);
  }
  return csv;
}

const std::string imu_columns =
    "imu:\n  axes: [-x, y, -z]\n  orientation: {from: [qx, qy, qz, qw], order: xyzw, reference: "
    "z_up}\n  angular_velocity: {from: [gx, gy, gz]}\n  proper_acceleration: {from: [ax, ay, "
    "az]}\n";
const std::string csv_mapping =
    fmt::format(
        "sources: {{joints: joint_states.csv, imu: imu.csv}}\n"
        "time: {{sec: header.stamp.sec, nanosec: header.stamp.nanosec}}\n"
        "joints: {{names: [{}]}}\n",
        fmt::join(joint_names, ", ")) +
    imu_columns;

TEST_F(JoinedLog, FilesAreJoinedAtTheJointsClock) {
  const Csv csv = robot_csv(1.0);
  const fs::path joints = write("joint_states.csv", csv.joints);
  const fs::path imu = write("imu.csv", csv.imu);
  for (const fs::path& log : {folder_.path(), joints, imu}) {
    const auto rows = convert(log, csv_mapping);
    EXPECT_EQ(rows.size(), 499U);
    expect_joined(rows);
    EXPECT_THAT(converted_.warnings,
                Contains(AllOf(HasSubstr("imu.csv: held"), HasSubstr("ms (median)"))));
  }
}

/// Rows of files by what their clocks show: joints at 500 Hz, an IMU at 200 Hz, measured at t.
struct Shown {
  std::string clock;
  double t = 0.0;
};

std::vector<Shown> shown(double rate, double seconds) {
  std::vector<Shown> rows;
  for (int k = 0; k < static_cast<int>(rate * seconds); ++k) {
    const double t = k / rate;
    rows.push_back({fmt::format("{:.4f}", t), t});
  }
  return rows;
}

const std::string shown_mapping =
    fmt::format(
        "sources: {{joints: joints.csv, imu: imu.csv}}\ntime: {{from: t}}\n"
        "joints: {{names: [{}]}}\n",
        fmt::join(joint_names, ", ")) +
    imu_columns;

class ClocksOfFiles : public JoinedLog {
 protected:
  void write_files() const {
    std::string joints = "t";
    for (const char* field : {"position", "velocity", "effort"}) {
      for (const std::string& name : joint_names) joints += fmt::format(",{}/{}", name, field);
    }
    for (const Shown& row : joints_) {
      joints += fmt::format("\n{}", row.clock);
      for (std::size_t i = 0; i < 6; ++i) joints += fmt::format(",{:.12g}", position(i, row.t));
      for (std::size_t i = 0; i < 6; ++i) joints += fmt::format(",{:.12g}", velocity(i, row.t));
      for (std::size_t i = 0; i < 6; ++i) joints += fmt::format(",{:.12g}", torque(i, row.t));
    }
    std::string imu = "t,qx,qy,qz,qw,gx,gy,gz,ax,ay,az";
    for (const Shown& row : imu_)
      imu += fmt::format("\n{},0,0,0,1,0,0,{},0,0,9.81", row.clock, row.t);
    write("joints.csv", joints + "\n");
    write("imu.csv", imu + "\n");
  }
  std::size_t converted_rows() {
    write_files();
    const std::vector<LogRow> rows = convert(folder_.path(), shown_mapping);
    for (const LogRow& row : rows) {
      // Each torque is its index and the time; the yaw rate is the IMU's time.
      const double age = row.observation.servo[0].torque + row.observation.imu.angular_velocity.z();
      EXPECT_GE(age, -1e-9);
      EXPECT_LE(age, 0.005 * 4 + 1e-9);  // behind three rows that are left out
    }
    return rows.size();
  }
  std::string complaint_of_files() {
    write_files();
    return complaint(folder_.path(), shown_mapping);
  }

  std::vector<Shown> joints_ = shown(500.0, 1.0);
  std::vector<Shown> imu_ = shown(200.0, 1.0);
};

TEST_F(ClocksOfFiles, AFewWrongTimesAreNoRestart) {
  const auto joints = joints_;
  const auto imu = imu_;
  for (const std::size_t at :
       {std::size_t{1}, std::size_t{70}, std::size_t{150}, std::size_t{198}}) {
    for (const double wrong : {-1e9, -2.0, -0.3, 0.3, 2.0, 1.7e9}) {
      for (const std::size_t count : {std::size_t{1}, std::size_t{2}}) {
        if (at + count > 199) continue;
        for (auto* file : {&joints_, &imu_}) {
          for (std::size_t i = at; i < at + count; ++i) {
            (*file)[i].clock = fmt::format("{:.4f}", (*file)[i].t + wrong);
          }
          const bool are_joints = file == &joints_;
          EXPECT_EQ(converted_rows(), are_joints ? 500U - count : 500U) << at << ' ' << wrong;
          EXPECT_THAT(
              converted_.warnings,
              Contains(AllOf(HasSubstr(are_joints ? "joints.csv: " : "imu.csv: "),
                             HasSubstr(fmt::format(": {} of ", count)), HasSubstr("contradict"),
                             HasSubstr(fmt::format("row {} ", at + 1)))))
              << at << ' ' << wrong;
          joints_ = joints;
          imu_ = imu;
        }
      }
    }
  }
}

TEST_F(ClocksOfFiles, RecordingsAreJoinedEachWithItsOwn) {
  const auto begin_again = [](std::vector<Shown>& rows, double rate, int times) {
    for (int k = 0; k < times; ++k) {
      for (const Shown& row : shown(rate, 1.0 + 0.3 * k)) {
        rows.push_back({row.clock, row.t + 10.0 * (k + 1)});
      }
    }
  };
  begin_again(joints_, 500.0, 2);
  begin_again(imu_, 200.0, 2);
  EXPECT_EQ(converted_rows(), 500U + 500U + 650U);
  EXPECT_EQ(converted_.time_reversals, 2U);
  EXPECT_EQ(converted_.incomplete_rows, 0U);
}

TEST_F(ClocksOfFiles, AWrongTimeBesideARestartIsLeftOut) {
  const auto again = [](std::vector<Shown>& rows, double rate) {
    for (const Shown& row : shown(rate, 1.0)) rows.push_back({row.clock, row.t + 10.0});
    return rows;
  };
  const auto joints = again(joints_, 500.0);
  const auto imu = again(imu_, 200.0);
  for (const std::size_t behind : {1U, 2U, 3U, 4U}) {
    for (const double wrong : {-0.5, 0.3, 1e6}) {
      joints_[500 + behind].clock = fmt::format("{}", wrong);
      EXPECT_EQ(converted_rows(), 999U) << behind << ' ' << wrong;
      EXPECT_EQ(converted_.time_reversals, 1U);
      joints_ = joints;
      imu_[200 + behind].clock = fmt::format("{}", wrong);
      EXPECT_EQ(converted_rows(), 1000U) << behind << ' ' << wrong;
      EXPECT_EQ(converted_.incomplete_rows, 0U) << behind << ' ' << wrong;
      imu_ = imu;
    }
  }
}

TEST_F(ClocksOfFiles, AFileThatLacksARecordingIsRefused) {
  for (auto* rows : {&joints_, &imu_}) {
    const auto once = *rows;
    rows->insert(rows->end(), once.begin(), once.end());
    EXPECT_THAT(complaint_of_files(),
                AllOf(HasSubstr("joints.csv starts again"), HasSubstr("nowhere"),
                      HasSubstr(fmt::format("at row {}", once.size() + 1)), HasSubstr("split")));
    *rows = once;
    // Its halves in the wrong order.
    std::rotate(rows->begin(), rows->begin() + 90, rows->end());
    EXPECT_THAT(complaint_of_files(), HasSubstr("nowhere"));
    *rows = once;
  }
}

TEST_F(ClocksOfFiles, ScrambledRowsAreRefused) {
  for (auto* rows : {&joints_, &imu_}) {
    const char* const file = rows == &joints_ ? "joints.csv go back" : "imu.csv go back";
    const auto once = *rows;
    std::ranges::reverse(*rows);
    EXPECT_THAT(complaint_of_files(), AllOf(HasSubstr(file), HasSubstr("sort")));
    *rows = once;
    std::mt19937 random(7);
    std::ranges::shuffle(*rows, random);
    EXPECT_THAT(complaint_of_files(), AllOf(HasSubstr(file), HasSubstr("sort")));
    *rows = once;
  }
}

TEST_F(ClocksOfFiles, TimesInMessagesHaveTheDigitsOfTheFile) {
  for (auto* rows : {&joints_, &imu_}) {
    for (Shown& row : *rows) row.clock = "173254000" + row.clock;
  }
  const auto in_order = imu_;
  std::ranges::reverse(imu_);
  EXPECT_THAT(complaint_of_files(), HasSubstr("(to 1732540000.89"));
  imu_ = in_order;
  imu_[70].clock = "1732540999.25";
  converted_rows();
  EXPECT_THAT(converted_.warnings, Contains(HasSubstr("first row 71 (1732540999.25 s)")));
}

TEST_F(ClocksOfFiles, RowsOfSmallDisorderAreSorted) {
  std::mt19937 random(7);
  for (auto* rows : {&joints_, &imu_}) {
    for (auto at = rows->begin(); rows->end() - at >= 10; at += 10) {
      std::shuffle(at, at + 10, random);
    }
  }
  EXPECT_EQ(converted_rows(), 500U);
  EXPECT_EQ(converted_.time_reversals, 0U);
}

TEST_F(ClocksOfFiles, RowsWithoutATimeAreCounted) {
  for (const char* nothing : {"", "nan", "inf"}) {
    joints_[20].clock = nothing;
    imu_[7].clock = imu_[8].clock = nothing;
    EXPECT_EQ(converted_rows(), 499U);
    EXPECT_THAT(converted_.warnings,
                AllOf(Contains(HasSubstr("joints.csv: 1 of 500 rows without a time are left out, "
                                         "first row 21")),
                      Contains(HasSubstr("imu.csv: 2 of 200 rows without a time are left out, "
                                         "first row 8"))));
  }
}

TEST_F(JoinedLog, EachFileMayHaveAClockOfItsOwnNameAndUnit) {
  const Csv csv = robot_csv(0.5);
  std::string imu = "stamp,qx,qy,qz,qw,gx,gy,gz,ax,ay,az\n";
  for (int k = 0; k < 100; ++k) {
    const double t = 0.005 * k + 0.00035;
    imu += fmt::format("{},0,0,0,1,0,0,{:.12g},0,0,9.81\n", stamp(t) / 1000, t);
  }
  write("joint_states.csv", csv.joints);
  write("imu.csv", imu);
  const auto rows = convert(folder_.path(), csv_mapping + "  time: {from: stamp, unit: us}\n");
  EXPECT_EQ(rows.size(), 249U);
  expect_joined(rows);
}

/// A joint state per row with its names, as programs write messages. `column` names the i-th entry
/// of a list.
std::string named_joints_csv(double seconds,
                             const std::function<std::string(const char*, int)>& column,
                             const std::function<std::vector<std::size_t>(int)>& order) {
  std::string csv = "header.stamp.sec,header.stamp.nanosec";
  for (const char* field : {"name", "position", "velocity", "effort"}) {
    for (int i = 0; i < 6; ++i) csv += fmt::format(",{}", column(field, i));
  }
  csv += "\n";
  for (int k = 0; k < static_cast<int>(500 * seconds); ++k) {
    const double t = 0.002 * k;
    std::vector<std::size_t> sent = order(k);
    const auto cells = [&](const auto& cell) {
      for (std::size_t i = 0; i < 6; ++i) csv += i < sent.size() ? cell(sent[i]) : std::string(",");
    };
    csv += sec_nanosec(t);
    cells([](std::size_t i) { return fmt::format(",{}", joint_names[i]); });
    cells([&](std::size_t i) { return fmt::format(",{:.12g}", position(i, t)); });
    cells([&](std::size_t i) { return fmt::format(",{:.12g}", velocity(i, t)); });
    cells([&](std::size_t i) { return fmt::format(",{:.12g}", torque(i, t)); });
    csv += "\n";
  }
  return csv;
}

/// The text with one part replaced.
std::string with_part(const std::string& text, const std::string& part, const std::string& by) {
  const std::size_t at = text.find(part);
  return fmt::format("{}{}{}", text.substr(0, at), by, text.substr(at + part.size()));
}

const auto in_brackets = [](const char* field, int i) { return fmt::format("{}[{}]", field, i); };

TEST_F(JoinedLog, JointsOfAFileAreFoundByTheNamesInItsRows) {
  write("imu.csv", robot_csv(0.5).imu);
  using Column = std::function<std::string(const char*, int)>;
  const std::vector<Column> styles = {
      in_brackets,
      [](const char* field, int i) { return fmt::format(".{}[{}]", field, i); },
      [](const char* field, int i) { return fmt::format("/joint_states/{}[{}]", field, i); },
      [](const char* field, int i) { return fmt::format("joint_states.{}_{}", field, i); },
      [](const char* field, int i) { return fmt::format("field.{}{}", field, i); },
      [](const char* field, int i) { return fmt::format("/joint_states/{}.{}", field, i); }};
  const auto same = [](int) { return all_joints; };
  const auto permuted = [](int k) {
    std::vector<std::size_t> order = all_joints;
    std::rotate(order.begin(), order.begin() + k % 6, order.end());
    return order;
  };
  for (std::size_t style = 0; style < styles.size(); ++style) {
    for (const auto& order : {std::function<std::vector<std::size_t>(int)>(same),
                              std::function<std::vector<std::size_t>(int)>(permuted)}) {
      write("joint_states.csv", named_joints_csv(0.5, styles[style], order));
      const auto rows = convert(folder_.path(), csv_mapping);
      EXPECT_EQ(rows.size(), 249U) << style;
      expect_joined(rows);
    }
  }
}

TEST_F(JoinedLog, AJointThatARowOfNamesLacksIsHeld) {
  write("imu.csv", robot_csv(0.5).imu);
  // Every third row has the left leg alone.
  write("joint_states.csv", named_joints_csv(0.5, in_brackets, [](int k) {
          return k % 3 == 2 ? std::vector<std::size_t>{2, 0, 1} : all_joints;
        }));
  const auto rows = convert(folder_.path(), csv_mapping);
  ASSERT_EQ(rows.size(), 249U);
  for (const LogRow& row : rows) {
    const double t = row.observation.time + start_ - 1e-9 * static_cast<double>(epoch);
    const bool is_held = std::llround(t / 0.002) % 3 == 2;
    EXPECT_NEAR(row.observation.servo[0].position, position(0, t), 1e-6);
    EXPECT_NEAR(row.observation.servo[4].torque, torque(4, is_held ? t - 0.002 : t), 1e-6);
  }
  EXPECT_GT(converted_.completed_rows, 80U);
  EXPECT_NEAR(converted_.oldest, 0.002, 1e-6);
}

TEST_F(JoinedLog, NamesThatAFileLacksHaveARemedy) {
  write("imu.csv", robot_csv(0.1).imu);
  write("joint_states.csv", named_joints_csv(0.1, in_brackets, [](int) { return all_joints; }));
  const std::string without =
      "sources: {joints: joint_states.csv, imu: imu.csv}\n"
      "time: {sec: header.stamp.sec, nanosec: header.stamp.nanosec}\njoints: {}\n" +
      imu_columns;
  EXPECT_THAT(complaint(folder_.path(), without),
              AllOf(HasSubstr("'names' is missing: expected the joints' names"),
                    HasSubstr("has r_wheel, l_wheel, l_hip, r_knee, l_knee, r_hip")));
  // Lists without names.
  std::string lists = read_file(folder_ / "joint_states.csv");
  for (int i = 0; i < 6; ++i) {
    lists = with_part(lists, fmt::format(",name[{}]", i), fmt::format(",unknown[{}]", i));
  }
  write("joint_states.csv", lists);
  EXPECT_THAT(complaint(folder_.path(), csv_mapping),
              AllOf(HasSubstr("map.yaml:3:"), HasSubstr("has neither columns NAME/position nor"),
                    HasSubstr("position: {from: [6 columns]}")));
}

TEST_F(JoinedLog, ArraysAreJoinedToo) {
  const std::size_t n = 500;
  ModelArrays joints;
  ModelArrays imu;
  const auto fill = [](ModelArray& array, std::vector<std::size_t> shape, const auto& value) {
    array.shape = std::move(shape);
    const std::size_t width = array.shape.size() == 2 ? array.shape[1] : 1;
    for (std::size_t k = 0; k < array.shape[0] * width; ++k) {
      array.data.push_back(value(k / width, k % width));
    }
  };
  const double zero = 1e-9 * static_cast<double>(epoch);
  const auto at = [](std::size_t k) { return 0.002 * static_cast<double>(k); };
  fill(joints["t"], {n}, [&](std::size_t k, std::size_t) { return zero + at(k); });
  fill(joints["q"], {n, 6}, [&](std::size_t k, std::size_t i) { return position(i, at(k)); });
  fill(joints["v"], {n, 6}, [&](std::size_t k, std::size_t i) { return velocity(i, at(k)); });
  fill(joints["m"], {n, 6}, [&](std::size_t k, std::size_t i) { return torque(i, at(k)); });
  const auto imu_time = [](std::size_t k) { return 0.005 * static_cast<double>(k) + 0.00035; };
  fill(imu["t"], {200}, [&](std::size_t k, std::size_t) { return zero + imu_time(k); });
  fill(imu["o"], {200, 4}, [](std::size_t, std::size_t i) { return i == 3 ? 1.0 : 0.0; });
  fill(imu["g"], {200, 3},
       [&](std::size_t k, std::size_t i) { return i == 2 ? imu_time(k) : 0.0; });
  fill(imu["a"], {200, 3}, [](std::size_t, std::size_t i) { return i == 2 ? 9.81 : 0.0; });
  write_npz(joints, folder_ / "joints.npz");
  write_npz(imu, folder_ / "imu.npz");
  const auto rows = convert(
      folder_.path(),
      "sources: {joints: joints.npz, imu: imu.npz}\ntime: {from: t}\njoints:\n  position: {from: "
      "q}\n  velocity: {from: v}\n  torque: {from: m}\nimu:\n  axes: [-x, y, -z]\n  orientation: "
      "{from: o, order: xyzw, reference: z_up}\n  angular_velocity: {from: g}\n  "
      "proper_acceleration: {from: a}\n");
  EXPECT_EQ(rows.size(), 499U);
  expect_joined(rows);
}

TEST_F(JoinedLog, SecondsAndNanosecondsAreOneClockOfOneFileToo) {
  std::string csv = "s,ns";
  for (int i = 0; i < 28; ++i) csv += fmt::format(",c{}", i);
  csv += "\n";
  for (int k = 0; k < 4; ++k) {
    csv += fmt::format("{},{}", 5 + k / 2, k % 2 == 0 ? 750'000'000 : 999'999'999);
    for (int i = 0; i < 28; ++i) csv += i == 18 ? ",1" : ",0";
    csv += "\n";
  }
  const auto rows = convert(
      write("log.csv", csv),
      "time: {sec: s, nanosec: ns}\njoints:\n  position: {from: [c0, c1, c2, c3, c4, c5]}\n  "
      "velocity: {from: [c6, c7, c8, c9, c10, c11]}\n  torque: {from: [c12, c13, c14, c15, c16, "
      "c17]}\nimu:\n  orientation: {from: [c18, c19, c20, c21]}\n  angular_velocity: {from: [c22, "
      "c23, c24]}\n  linear_acceleration: {from: [c25, c26, c27]}\n");
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(start_, 5.75);
  EXPECT_NEAR(rows[3].observation.time, 6.999999999 - 5.75, 1e-9);
}

/// The outer join of two topics, as one source or as two.
TEST_F(JoinedLog, RowsThatLackHalfOfTheirCellsAreHeldAtTheJointsClock) {
  const std::string nothing(17, ',');
  for (const bool meets : {true, false}) {  // whether some rows are of both
    std::string csv = "t";
    for (const char* field : {"position", "velocity", "effort"}) {
      for (const std::string& name : joint_names) csv += fmt::format(",{}/{}", name, field);
    }
    csv += ",qx,qy,qz,qw,gx,gy,gz,ax,ay,az\n";
    for (int k = 0; k < 1000; ++k) {
      const bool is_joint = k % 2 == 0;
      const bool is_imu = k % 5 == (meets ? 0 : 1) && (meets || !is_joint);
      if (!is_joint && !is_imu) continue;
      const double t = 0.001 * k;
      csv += fmt::format("{}", t);
      const auto cell = [&](double value) { csv += is_joint ? fmt::format(",{}", value) : ","; };
      for (std::size_t i = 0; i < 6; ++i) cell(position(i, t));
      for (std::size_t i = 0; i < 6; ++i) cell(velocity(i, t));
      for (std::size_t i = 0; i < 6; ++i) cell(torque(i, t));
      csv += is_imu ? fmt::format(",0,0,0,1,0,0,{},0,0,9.81\n", t) : ",,,,,,,,,,\n";
    }
    const fs::path log = write("joined.csv", csv);
    const std::string head =
        fmt::format("time: {{from: t}}\njoints: {{names: [{}]}}\n", fmt::join(joint_names, ", ")) +
        imu_columns;
    const auto held = convert(log, head);
    EXPECT_NEAR(static_cast<double>(held.size()), 500.0, 5.0);
    EXPECT_LE(converted_.incomplete_rows, 1U);  // before the first row of the IMU
    const auto rows = convert(log, "sources: {joints: joined.csv, imu: joined.csv}\n" + head);
    EXPECT_NEAR(static_cast<double>(rows.size()), 500.0, 5.0);
    EXPECT_EQ(converted_.incomplete_rows, 0U);
  }
}

}  // namespace
}  // namespace touchdown::logs
