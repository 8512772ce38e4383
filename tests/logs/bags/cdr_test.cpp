#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "logs/bags/topic_rows.hpp"
#include "tests/bag_writer.hpp"

namespace touchdown::logs {
namespace {

const test::TestJoints joints = {{"a", "left_hip_joint", "", "knee"},
                                 {1.0, 2.0, 3.0, 4.0},
                                 {5.0, 6.0, 7.0, 8.0},
                                 {9.0, 10.0, std::nan(""), 12.0}};

const MessageType joint_states(joint_state_type, "");
const MessageType imus(imu_type, "");

/// Every beginning of a message is refused, whatever is missing.
TEST(Cdr, MessagesThatAreCutOffAreRefused) {
  const std::string joint_state = test::joint_state_cdr(1, joints);
  const std::string imu = test::imu_cdr(1, {});
  MessageNumbers numbers;
  for (std::size_t size = 0; size < joint_state.size(); ++size) {
    EXPECT_THROW(joint_states.decode(joint_state.substr(0, size), numbers), InputError) << size;
  }
  for (std::size_t size = 0; size < imu.size(); ++size) {
    EXPECT_THROW(imus.decode(imu.substr(0, size), numbers), InputError) << size;
  }
}

TEST(Cdr, MalformedMessagesAreRefused) {
  MessageNumbers numbers;
  std::string payload = test::joint_state_cdr(1, joints);
  for (const char kind : {'\2', '\3', '\6', '\7', '\12', '\377'}) {
    payload[1] = kind;
    EXPECT_THROW(joint_states.decode(payload, numbers), InputError);
  }
  test::TestJoints wrong = joints;
  wrong.velocity.pop_back();
  EXPECT_THROW(joint_states.decode(test::joint_state_cdr(1, wrong), numbers), InputError);
  // A billion names, a text of four gigabytes, and more than a second of nanoseconds.
  for (const std::uint32_t count : {0x40000000U, 0xffffffffU}) {
    test::CdrBytes names;
    names.u32(1).u32(1).text("").u32(count);
    EXPECT_THROW(joint_states.decode(names.bytes(), numbers), InputError);
    test::CdrBytes text;
    text.u32(1).u32(1).u32(count);
    EXPECT_THROW(joint_states.decode(text.bytes(), numbers), InputError);
  }
  test::CdrBytes stamp;
  stamp.u32(1).u32(1'000'000'000).text("").u32(0).f64s({}).f64s({}).f64s({});
  EXPECT_THROW(joint_states.decode(stamp.bytes(), numbers), InputError);
}

}  // namespace
}  // namespace touchdown::logs
