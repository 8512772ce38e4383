#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "logs/bags/topic_rows.hpp"
#include "tests/bag_writer.hpp"
#include "tests/logs/mapping/mapped_logs.hpp"

namespace touchdown::logs {
namespace {

namespace bags = touchdown::test;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr std::int64_t stamp_step = 5'000'000;  // ns
constexpr std::size_t row_count = 60;

double position(std::size_t i, std::size_t k) { return 0.1 * static_cast<double>(i * 7 + k); }

/// Bags with messages of a robot's own type.
class OwnTypes : public test::MappedLogs {
 protected:
  /// A bag with a topic /state of this definition. `put` writes message k behind CDR's header.
  static bags::TestBag bag_of(const std::string& definition, bool is_big,
                              const std::function<void(bags::CdrBytes&, std::size_t k)>& put) {
    bags::TestBag bag{{{"/state", "my_msgs/msg/State", "cdr", definition}}, {}};
    for (std::size_t k = 0; k < row_count; ++k) {
      bags::CdrBytes bytes(is_big);
      put(bytes, k);
      const std::int64_t time =
          1'700'000'000'000'000'000 + static_cast<std::int64_t>(k) * stamp_step;
      bag.messages.push_back({0, time, bytes.bytes()});
    }
    return bag;
  }
  std::filesystem::path write_bag(const bags::TestBag& bag) const {
    return write("bag.mcap", bags::mcap_bytes(bag));
  }
  void expect_positions(const std::vector<LogRow>& read) {
    ASSERT_EQ(read.size(), row_count);
    for (std::size_t k = 0; k < row_count; ++k) {
      EXPECT_NEAR(read[k].observation.time, 0.005 * static_cast<double>(k), 1e-6);
      for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_NEAR(read[k].observation.servo[i].position, position(i, k), 1e-5);
      }
    }
  }
};

/// As of a quadruped's driver: motors in an array, an IMU with a quaternion w x y z.
const std::string motors_definition = R"(uint8 MODE=3   # a constant
uint8[2] head
uint8 level
string name "none"
my_msgs/Motor[<=8] motor
Imu imu
uint8[] picture
================================================================================
MSG: my_msgs/Motor
float32 q      # rad
float32 dq
float64 tau
================================================================================
MSG: my_msgs/Imu
float64[4] quaternion
float64[3] gyro
float64[3] accelerometer
)";
const std::string motors_mapping = R"(sources: {joints: /state, imu: /state}
joints:
  position: {from: "motor[].q"}
  velocity: {from: "motor[].dq", index: [0, 1, 2, 3, 4, 5]}
  torque: {from: ["motor[0].tau", "motor[1].tau", "motor[2].tau", "motor[3].tau", "motor[4].tau", "motor[5].tau"]}
imu: {orientation: {from: imu.quaternion}, angular_velocity: {from: imu.gyro}, proper_acceleration: {from: imu.accelerometer}}
)";

void put_motors(bags::CdrBytes& bytes, std::size_t k) {
  bytes.u8(1).u8(2).u8(static_cast<std::uint8_t>(k));
  bytes.text(std::string(k % 5, 'x'));
  bytes.u32(6);
  for (std::size_t i = 0; i < 6; ++i) {
    bytes.f32(static_cast<float>(position(i, k))).f32(0.5F).f64(static_cast<double>(k));
  }
  for (const double x : {1.0, 0.0, 0.0, 0.0, 0.1, 0.2, 0.3, 0.0, 0.0, 9.81}) bytes.f64(x);
  bytes.u32(static_cast<std::uint32_t>(2000 + k));
  for (std::size_t i = 0; i < 2000 + k; ++i) bytes.u8(7);
}

TEST_F(OwnTypes, AreReadByTheDefinitionThatTheBagCarries) {
  for (const bool is_big : {false, true}) {
    const bags::TestBag bag = bag_of(motors_definition, is_big, put_motors);
    const std::filesystem::path db3 = folder_ / fmt::format("{}.db3", is_big);
    bags::write_db3(bag, db3);
    for (const std::filesystem::path& path : {write_bag(bag), db3}) {
      const std::vector<LogRow> read = convert(path, motors_mapping);
      expect_positions(read);
      EXPECT_EQ(read[9].observation.servo[4].torque, 9.0);
      EXPECT_NEAR(read[9].observation.servo[4].velocity, 0.5, 1e-6);
      EXPECT_EQ(read[9].observation.imu.angular_velocity.z(), 0.3);
    }
  }
}

TEST_F(OwnTypes, OfMoreMotorsThanJointsNeedAnIndex) {
  const auto put_twelve = [](bags::CdrBytes& bytes, std::size_t k) {
    std::vector<double> positions;
    for (std::size_t i = 0; i < 12; ++i) positions.push_back(position(i, k));
    bytes.f64s(positions).f64s({1.0, 0.0, 0.0, 0.0}).f64s({0.1, 0.2, 0.3});
  };
  const std::filesystem::path bag =
      write_bag(bag_of("float64[] q\nfloat64[] o\nfloat64[] g\n", false, put_twelve));
  const std::string mapping =
      "sources: {joints: /state, imu: /state}\njoints:\n  position: {from: q, index: [0, 1, 2, 3, "
      "4, "
      "5]}\n  velocity: {from: q}\n  torque: {from: o}\n"
      "imu: {orientation: {from: o}, angular_velocity: {from: g}, proper_acceleration: {from: "
      "g}}\n";
  EXPECT_THAT(
      complaint(bag, mapping),
      HasSubstr("joints.velocity.from: 'q' has 12 numbers: expected `index` with 6 of them"));
}

/// The stamp of the header counts, not the time of recording; lists grow and shrink.
TEST_F(OwnTypes, MayHaveAHeaderListsOfAnyLengthAndAClockOfTheirOwn) {
  const std::string definition = R"(std_msgs/Header header
uint32 tick
int16[] extra
float64[] pos
float64[] zeros
===========
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
)";
  const auto put = [](bags::CdrBytes& bytes, std::size_t k) {
    bytes.u32(5)
        .u32(static_cast<std::uint32_t>(k * stamp_step))
        .text("base")
        .u32(static_cast<std::uint32_t>(5 * k));
    bytes.u32(static_cast<std::uint32_t>(k % 3));
    for (std::size_t i = 0; i < k % 3; ++i) bytes.u8(1).u8(0);
    std::vector<double> positions;
    for (std::size_t i = 0; i < 6; ++i) positions.push_back(position(i, k));
    bytes.f64s(positions).f64s(std::vector<double>(28, 0.5));
  };
  bags::TestBag bag = bag_of(definition, false, put);
  for (bags::TestMessage& message : bag.messages) message.time += 1000 * (message.time % 7);
  const auto mapping = [](const std::string& time) {
    return "sources: {joints: /state, imu: /state}\n" + time +
           "joints: {position: {from: pos}, velocity: {from: zeros, index: [0, 1, 2, 3, 4, 5]}, "
           "torque: {from: zeros, index: "
           "[6, 7, 8, 9, 10, 11]}}\nimu: {orientation: {from: zeros, index: [12, 13, 14, 15]}, "
           "angular_velocity: {from: zeros, index: [16, 17, 18]}, proper_acceleration: {from: "
           "zeros, index: [19, 20, 21]}}\n";
  };
  for (const std::string time : {"", "time: {from: tick, unit: ms}\n"}) {
    expect_positions(convert(write_bag(bag), mapping(time)));
  }
}

TEST_F(OwnTypes, WithoutAReadableDefinitionAreRefusedWithTheReason) {
  const struct {
    std::string definition;
    std::string text;
  } cases[] = {
      {"", "the bag has no definition of it in .msg"},
      {"# nothing", "my_msgs/State has no fields"},
      {"Other other\n", "the bag has no definition of my_msgs/Other"},
      {"State again\n", "my_msgs/State contains itself"},
      {"float64[x] a\n",
       "expected `type name` in the definition of my_msgs/State, found 'float64[x] a'"},
      {"float64\n", "expected `type name`"},
  };
  for (const auto& [definition, text] : cases) {
    const bags::TestBag bag = bag_of(definition, false, put_motors);
    EXPECT_THAT(complaint(write_bag(bag), motors_mapping),
                AllOf(HasSubstr("topic /state has the type 'my_msgs/msg/State'"), HasSubstr(text)));
  }
  bags::TestBag json = bag_of(motors_definition, false, put_motors);
  json.topics[0].encoding = "json";
  EXPECT_THAT(complaint(write_bag(json), motors_mapping),
              HasSubstr("messages in 'json', expected cdr"));
  const bags::TestBag bag = bag_of(motors_definition, false, put_motors);
  EXPECT_THAT(complaint(write_bag(bag),
                        "sources: {joints: /state, imu: /state}\njoints: {position: {from: q}}\n"),
              HasSubstr("expected 6 of the names of columns"));
  EXPECT_THAT(complaint(write_bag(bag),
                        "sources: {joints: /state, imu: /state}\njoints: {position: {from: [a, b, "
                        "c, d, e, f]}}\n"),
              HasSubstr("(it has header.stamp, log_time, head[i], level, motor[i].q, motor[i].dq"));
  // Each beginning of a message is refused, or is a message with shorter lists.
  bags::TestBag cut = bag;
  for (std::size_t k = 0; k < row_count; ++k) cut.messages[k].data.resize(4 + k);
  EXPECT_THAT(complaint(write_bag(cut), motors_mapping), HasSubstr("can be decoded: "));
}

/// Drivers that leave the list of names empty, and those that send a part of them.
TEST_F(OwnTypes, JointStatesWithoutNamesAreReadByIndex) {
  bags::TestBag bag{{{"/joint_states", joint_state_type}, {"/imu", imu_type}}, {}};
  for (std::size_t k = 0; k < row_count; ++k) {
    const std::int64_t time = 1'700'000'000'000'000'000 + static_cast<std::int64_t>(k) * stamp_step;
    bags::TestJoints state;
    for (const std::size_t i : {3U, 4U, 5U, 0U, 1U, 2U}) state.position.push_back(position(i, k));
    state.velocity = state.effort = state.position;
    bag.messages.push_back({0, time, bags::joint_state_cdr(time, state)});
    bag.messages.push_back({1, time, bags::imu_cdr(time, {})});
  }
  const std::filesystem::path path = write_bag(bag);
  EXPECT_THAT(complaint(path, "joints: {names: [a, b, c, d, e, f]}\n"),
              AllOf(HasSubstr("map.yaml:1:17: joints.names: names are empty in the messages of "
                              "/joint_states; give positions by index"),
                    HasSubstr("position: {from: position, index: [6 numbers from 0]}")));
  const std::string order = "index: [3, 4, 5, 0, 1, 2]";
  for (const std::string& mapping :
       {fmt::format(
            "joints: {{position: {{from: position, {0}}}, velocity: {{from: velocity, {0}}}, "
            "torque: {{from: effort, {0}}}}}\n",
            order),
        fmt::format("joints:\n  position: {{from: ['position[3]', 'position[4]', 'position[5]', "
                    "'position[0]', 'position[1]', 'position[2]']}}\n  velocity: {{from: velocity, "
                    "{0}}}\n  torque: {{from: effort, {0}}}\n",
                    order)}) {
    expect_positions(convert(path, "sources: {imu: /imu}\n" + mapping));
  }
}

}  // namespace
}  // namespace touchdown::logs
