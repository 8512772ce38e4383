#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/table.hpp"
#include "logs/log/recording_file.hpp"
#include "program.hpp"
#include "result_files.hpp"
#include "synthetic_log.hpp"

namespace touchdown::cli {
namespace {

using ::testing::HasSubstr;

struct Message {
  std::string topic;
  std::string schema;      ///< its name
  std::uint64_t time = 0;  ///< ns
  nlohmann::json json;
};

class Mcap : public InFolder {
 protected:
  std::string ran(const std::string& arguments) { return folder_.output_of(arguments); }
  /// The messages that an independent reader, written from the format's specification, finds.
  std::vector<Message> read(const std::string& file) {
    const std::string command = fmt::format("cd '{}' && python3 " TOUCHDOWN_SOURCE_DIR
                                            "/tests/cli/read_mcap.py {} > messages 2>&1",
                                            folder_.path().string(), file);
    const int status = std::system(command.c_str());
    EXPECT_EQ(status, 0) << folder_.text("messages").substr(0, 2000);
    std::vector<Message> messages;
    std::ifstream output(folder_ / "messages");
    while (status == 0 && output.peek() != std::ifstream::traits_type::eof()) {
      Message& message = messages.emplace_back();
      std::string json;
      output >> message.topic >> message.schema >> message.time;
      std::getline(output, json);
      message.json = nlohmann::json::parse(json);
    }
    return messages;
  }
};

TEST_F(Mcap, HoldsSignalsAndBeliefsOfEveryStep) {
  // More than one chunk, and a clock that does not begin at 0.
  logs::Recording log = test::synthetic_log(1.5);
  for (models::Observation& o : log.observation) o.time += 0.25;
  logs::write_recording(log, folder_ / "log.mpack");
  ran("estimate log.mpack -o with.mpack -o beliefs.csv");
  EXPECT_THAT(ran("convert with.mpack -o with.mcap"), HasSubstr("with.mcap, 1500 records"));
  ran("convert with.mpack -o again.mcap");
  EXPECT_EQ(folder_.text("with.mcap"), folder_.text("again.mcap"));

  const std::vector<Message> messages = read("with.mcap");
  const TextTable beliefs = from_csv(folder_.text("beliefs.csv"));
  ASSERT_EQ(messages.size(), 3000U);
  ASSERT_EQ(beliefs.rows.size(), 1500U);
  EXPECT_GT(std::filesystem::file_size(folder_ / "with.mcap"), 2U << 20U);
  for (std::size_t k = 0; k < 1500; ++k) {
    const Message& observed = messages[2 * k];
    const Message& believed = messages[2 * k + 1];
    ASSERT_EQ(observed.topic, "/upkie/observation");
    ASSERT_EQ(believed.topic, "/touchdown/beliefs");
    ASSERT_EQ(observed.time, 250'000'000U + 1'000'000U * k);
    ASSERT_EQ(believed.time, observed.time);
    const models::Observation& o = log.observation[k];
    ASSERT_EQ(observed.json["servo"]["right_knee"]["torque"], o.servo[4].torque);
    ASSERT_EQ(observed.json["imu"]["linear_acceleration"][2], o.imu.linear_acceleration.z());
    ASSERT_FALSE(observed.json.contains("contact_filter"));
    const auto& filter = believed.json["contact_filter"];
    ASSERT_EQ(filter["left_wheel"]["p_contact"], std::stod(beliefs.rows[k][1]));
    ASSERT_EQ(filter["right_wheel"]["contact"], beliefs.rows[k][4] == "1");
    ASSERT_TRUE(filter["p_contact_smooth"].is_null());  // NaN is no number in JSON
  }
}

TEST_F(Mcap, ShowsRobotTerrainAndTakeoffsOfASimulatedRun) {
  ran("simulate " TOUCHDOWN_SOURCE_DIR "/scenarios/stairs.yaml --set end.duration=5 -o run.mpack");
  ran("convert run.mpack -o run.mcap");
  const logs::Recording run = logs::read_recording(folder_ / "run.mpack");
  std::map<std::string, std::vector<Message>> by_schema;
  for (Message& message : read("run.mcap")) by_schema[message.schema].push_back(message);

  ASSERT_EQ(by_schema["foxglove.SceneUpdate"].size(), 1U);
  const auto& entities = by_schema["foxglove.SceneUpdate"][0].json["entities"];
  std::set<std::string> frames;
  std::size_t triangles = 0;
  for (const auto& entity : entities) {
    frames.insert(entity["frame_id"]);
    for (const auto& mesh : entity["triangles"]) {
      triangles += mesh["indices"].size() / 3;
      for (const auto& index : mesh["indices"]) ASSERT_LT(index, mesh["points"].size());
    }
  }
  EXPECT_TRUE(frames.contains("world") && frames.contains("torso"));
  EXPECT_GE(frames.size(), 6U);  // and wheels, and links of both legs
  EXPECT_GT(triangles, 10U) << "no terrain";

  const auto& poses = by_schema["foxglove.FrameTransforms"];
  ASSERT_EQ(poses.size(), (run.steps() + 19) / 20);  // 50 a second
  for (const Message& message : poses) {
    const std::size_t row = message.time / 1'000'000U;
    std::set<std::string> moved;
    for (const auto& transform : message.json["transforms"]) {
      moved.insert(transform["child_frame_id"]);
      if (transform["child_frame_id"] != "torso") continue;
      const Eigen::Vector3d& base = run.truth[row].base_position;
      ASSERT_NEAR(transform["translation"]["x"], base.x(), 1e-9);
      ASSERT_NEAR(transform["translation"]["z"], base.z(), 1e-9);
      ASSERT_NEAR(std::abs(transform["rotation"]["w"].get<double>()),
                  std::abs(run.truth[row].base_orientation.w()), 1e-6);
    }
    for (const std::string& frame : frames) {
      ASSERT_TRUE(frame == "world" || moved.contains(frame)) << frame;
    }
  }

  // A takeoff is a step in contact before one without.
  std::size_t takeoffs = 0;
  for (const Message& message : by_schema["foxglove.Log"]) {
    if (!message.json["message"].get<std::string>().starts_with("left wheel takes off")) continue;
    ++takeoffs;
    const std::size_t row = message.time / 1'000'000U;
    EXPECT_GT(run.truth[row - 1].wheel_normal_force[0], 0.99);  // .019 of the weight
    EXPECT_LE(run.truth[row].wheel_normal_force[0], 1.0);
  }
  EXPECT_GE(takeoffs, 1U);
  ASSERT_EQ(run.info.outcome, logs::Outcome::timed_out);
  EXPECT_EQ(by_schema["foxglove.Log"].back().json["message"], "timed out");
}

TEST_F(Mcap, OfARobotKeepsItsClockAndShowsTheNamedRobot) {
  const std::string example = TOUCHDOWN_SOURCE_DIR "/examples/mapping/robot";
  ran(fmt::format("convert {0}.csv --mapping {0}.yaml -o robot.mpack", example));
  ran("convert robot.mpack -o robot.mcap");
  const std::vector<Message> messages = read("robot.mcap");
  ASSERT_EQ(messages.size(), 10U);
  EXPECT_EQ(messages[0].time, 81'000'000'000U);
  EXPECT_EQ(messages[9].time, 81'009'000'000U);
  EXPECT_EQ(messages[9].topic, "/upkie/observation");

  logs::write_recording(test::robot_log(1.0), folder_ / "log.mpack");
  ran("convert log.mpack --robot " TOUCHDOWN_SOURCE_DIR "/models/upkie.xml -o log.mcap");
  std::map<std::string, std::size_t> count;
  for (const Message& message : read("log.mcap")) ++count[message.schema];
  EXPECT_EQ(count["foxglove.SceneUpdate"], 1U);
  EXPECT_EQ(count["foxglove.FrameTransforms"], 50U);
  EXPECT_EQ(count["foxglove.Log"], 0U) << "nothing is true in a robot's log";
}

TEST_F(Mcap, OfNoLogIsRefusedAndNothingIsWritten) {
  folder_.write("text.mpack", "no log");
  // A record with an additional key that is a number, which JSON does not allow.
  logs::write_recording(test::robot_log(0.002), folder_ / "keys.mpack");
  std::string bytes = folder_.text("keys.mpack");
  const auto entries = static_cast<unsigned char>(bytes[0]);
  ASSERT_EQ(entries & 0xf0U, 0x80U);  // a map of a few entries, which gets one more
  bytes[0] = static_cast<char>(entries + 1);
  bytes.insert(1, "\x05\x05");
  folder_.write("keys.mpack", bytes);
  folder_.expect_refusals({{"convert text.mpack -o a.mcap", {"text.mpack: byte 0: expected"}},
                           {"convert none.mpack -o a.mcap", {"none.mpack: no such file"}},
                           {"convert keys.mpack -o a.mcap", {"keys.mpack: a record cannot be"}}});
  EXPECT_EQ(names_in(folder_.path()),
            (std::set<std::string>{".stderr", ".stdout", "text.mpack", "keys.mpack"}));
}

}  // namespace
}  // namespace touchdown::cli
