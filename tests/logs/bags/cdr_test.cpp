#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "logs/bags/sensor_messages.hpp"
#include "tests/bag_writer.hpp"

namespace touchdown::logs {
namespace {

const test::TestJoints joints = {{"a", "left_hip_joint", "", "knee"},
                                 {1.0, 2.0, 3.0, 4.0},
                                 {5.0, 6.0, 7.0, 8.0},
                                 {9.0, 10.0, std::nan(""), 12.0}};

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
