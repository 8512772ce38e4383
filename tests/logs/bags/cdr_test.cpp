#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "logs/bags/sensor_messages.hpp"
#include "tests/bag_writer.hpp"

namespace touchdown::logs {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const test::TestJoints joints = {{"a", "left_hip_joint", "", "knee"},
                                 {1.0, 2.0, 3.0, 4.0},
                                 {5.0, 6.0, 7.0, 8.0},
                                 {9.0, 10.0, std::nan(""), 12.0}};

TEST(Cdr, JointStatesOfBothByteOrdersAreRead) {
  for (const bool is_big : {false, true}) {
    JointState state;
    const std::string payload = test::joint_state_cdr(17'000'000'042, joints, is_big);
    decode(payload, state);
    EXPECT_EQ(state.stamp.time(), 17'000'000'042);
    EXPECT_THAT(state.name, ElementsAre("a", "left_hip_joint", "", "knee"));
    EXPECT_EQ(state.position, joints.position);
    EXPECT_EQ(state.velocity, joints.velocity);
    EXPECT_EQ(state.effort[3], 12.0);
    EXPECT_TRUE(std::isnan(state.effort[2]));
  }
}

TEST(Cdr, ListsOfAJointStateMayBeEmpty) {
  for (int empty = 0; empty < 8; ++empty) {
    test::TestJoints some = joints;
    if ((empty & 1) != 0) some.position.clear();
    if ((empty & 2) != 0) some.velocity.clear();
    if ((empty & 4) != 0) some.effort.clear();
    JointState state;
    decode(test::joint_state_cdr(1, some), state);
    EXPECT_EQ(state.position.size(), some.position.size());
    EXPECT_EQ(state.velocity.size(), some.velocity.size());
    EXPECT_EQ(state.effort.size(), some.effort.size());
  }
}

TEST(Cdr, ImusOfBothByteOrdersAreRead) {
  const test::TestImu imu{{.1, .2, .3, .4}, {1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}, 0.5};
  for (const bool is_big : {false, true}) {
    ImuState state;
    decode(test::imu_cdr(5'000'000'006, imu, is_big), state);
    EXPECT_EQ(state.stamp.sec, 5);
    EXPECT_EQ(state.stamp.nanosec, 6U);
    EXPECT_EQ(state.orientation, imu.orientation);
    EXPECT_EQ(state.angular_velocity, imu.angular_velocity);
    EXPECT_EQ(state.linear_acceleration, imu.linear_acceleration);
  }
}

TEST(Cdr, AnOrientationThatIsNotGivenIsMissing) {
  const test::TestImu by_covariance{.orientation_covariance = -1.0};
  const test::TestImu by_zeros{.orientation = {0.0, 0.0, 0.0, 0.0}};
  for (const test::TestImu& imu : {by_covariance, by_zeros}) {
    ImuState state;
    decode(test::imu_cdr(1, imu), state);
    EXPECT_TRUE(std::isnan(state.orientation[3]));
    EXPECT_EQ(state.linear_acceleration[2], 9.81);
  }
}

/// Every beginning of a message is refused, whatever is missing.
TEST(Cdr, MessagesThatAreCutOffAreRefused) {
  const std::string joint_state = test::joint_state_cdr(1, joints);
  const std::string imu = test::imu_cdr(1, {});
  JointState joint;
  ImuState imu_state;
  for (std::size_t size = 0; size < joint_state.size(); ++size) {
    EXPECT_THROW(decode(joint_state.substr(0, size), joint), InputError) << size;
  }
  for (std::size_t size = 0; size < imu.size(); ++size) {
    EXPECT_THROW(decode(imu.substr(0, size), imu_state), InputError) << size;
  }
}

TEST(Cdr, MalformedMessagesAreRefused) {
  JointState state;
  std::string payload = test::joint_state_cdr(1, joints);
  for (const char kind : {'\2', '\3', '\6', '\7', '\12', '\377'}) {
    payload[1] = kind;
    EXPECT_THROW(decode(payload, state), InputError);
  }
  test::TestJoints wrong = joints;
  wrong.velocity.pop_back();
  EXPECT_THROW(decode(test::joint_state_cdr(1, wrong), state), InputError);
  // A billion names, a text of four gigabytes, and more than a second of nanoseconds.
  for (const std::uint32_t count : {0x40000000U, 0xffffffffU}) {
    test::CdrBytes names;
    names.u32(1).u32(1).text("").u32(count);
    EXPECT_THROW(decode(names.bytes(), state), InputError);
    test::CdrBytes text;
    text.u32(1).u32(1).u32(count);
    EXPECT_THROW(decode(text.bytes(), state), InputError);
  }
  test::CdrBytes stamp;
  stamp.u32(1).u32(1'000'000'000).text("").u32(0).f64s({}).f64s({}).f64s({});
  EXPECT_THROW(decode(stamp.bytes(), state), InputError);
}

}  // namespace
}  // namespace touchdown::logs
