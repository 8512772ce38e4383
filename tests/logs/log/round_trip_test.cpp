#include <bit>
#include <cmath>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "logs/log/reader.hpp"
#include "logs/log/recording_file.hpp"
#include "logs/log/writer.hpp"
#include "tests/logs/log/sample_recording.hpp"
#include "tests/logs/log/upkie_log.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::logs {
namespace {

using test::sample_recording;

/// Every number of a row as bits, gathered member by member without the help of the library.
std::vector<std::uint64_t> bits(const Recording& recording, std::size_t step) {
  std::vector<std::uint64_t> all;
  const auto add = [&](std::initializer_list<double> values) {
    for (const double value : values) all.push_back(std::bit_cast<std::uint64_t>(value));
  };
  const auto add_vector = [&](const Eigen::Vector3d& v) { add({v.x(), v.y(), v.z()}); };
  const auto add_rotation = [&](const Eigen::Quaterniond& q) { add({q.w(), q.x(), q.y(), q.z()}); };
  const models::Observation& o = recording.observation.at(step);
  add({o.time, o.pitch, o.pitch_rate, o.yaw, o.yaw_rate});
  for (const models::ServoReading& s : o.servo) add({s.position, s.velocity, s.torque});
  for (const models::ServoReading& s : o.motor) add({s.position, s.velocity, s.torque});
  add_rotation(o.imu.orientation);
  add_vector(o.imu.angular_velocity);
  add_vector(o.imu.linear_acceleration);
  add_vector(o.imu.raw_linear_acceleration);
  for (const models::ServoCommand& s : recording.action.at(step).servo) {
    add({s.feedforward_torque, s.position, s.velocity, s.kp_scale, s.kd_scale, s.maximum_torque});
  }
  if (recording.truth.empty()) return all;
  const models::GroundTruth& t = recording.truth.at(step);
  add_vector(t.base_position);
  add_rotation(t.base_orientation);
  add_vector(t.base_linear_velocity);
  add_vector(t.base_angular_velocity);
  add_vector(t.imu_linear_velocity);
  add({t.wheel_normal_force[0], t.wheel_normal_force[1], t.body_touches_terrain ? 1.0 : 0.0});
  for (const models::ServoReading& s : t.held) add({s.position, s.velocity, s.torque});
  if (!t.joint_torque) return all;
  for (const double torque : *t.joint_torque) add({torque});
  return all;
}

void expect_same(const Recording& a, const Recording& b) {
  EXPECT_EQ(a.info.scenario, b.info.scenario);
  EXPECT_EQ(a.info.simulator, b.info.simulator);
  EXPECT_EQ(a.info.seed, b.info.seed);
  EXPECT_EQ(a.info.run, b.info.run);
  EXPECT_EQ(a.info.control_period_us, b.info.control_period_us);
  EXPECT_EQ(a.info.outcome, b.info.outcome);
  EXPECT_EQ(a.info.scenario_yaml, b.info.scenario_yaml);
  EXPECT_EQ(a.info.robot_digest, b.info.robot_digest);
  ASSERT_EQ(a.steps(), b.steps());
  ASSERT_EQ(a.action.size(), b.action.size());
  ASSERT_EQ(a.truth.size(), b.truth.size());
  for (std::size_t step = 0; step < a.steps(); ++step) {
    ASSERT_EQ(bits(a, step), bits(b, step)) << "step " << step;
  }
}

TEST(RoundTrip, KeepsEveryBitOfASimulatedRun) {
  const ScratchFolder folder;
  const Recording recording = sample_recording(700);  // several chunks of the reader's buffer
  write_recording(recording, folder / "run.mpack");
  std::vector<std::string> warnings;
  expect_same(read_recording(folder / "run.mpack", &warnings), recording);
  EXPECT_THAT(warnings, ::testing::IsEmpty());
}

TEST(RoundTrip, KeepsWhatJointsFeelWhereServosDoNotKnowIt) {
  const ScratchFolder folder;
  Recording recording = sample_recording(5);
  write_recording(recording, folder / "ideal.mpack");
  for (std::size_t step = 0; step < recording.steps(); ++step) {
    auto& torque = recording.truth[step].joint_torque.emplace();
    for (std::size_t i = 0; i < torque.size(); ++i) {
      torque[i] = 0.1 * static_cast<double>(step) - static_cast<double>(i);
    }
  }
  write_recording(recording, folder / "run.mpack");
  const Recording read = read_recording(folder / "run.mpack");
  ASSERT_TRUE(read.truth.back().joint_torque);
  expect_same(read, recording);
  EXPECT_EQ(read_file(folder / "ideal.mpack").find("joint_torque"), std::string::npos);
}

TEST(RoundTrip, KeepsHeldJoints) {
  const ScratchFolder folder;
  for (const int count : {1, 2, 5, models::most_held}) {
    Recording recording = sample_recording(5);
    for (std::size_t step = 0; step < recording.steps(); ++step) {
      for (int joint = 0; joint < count; ++joint) {
        const double x = 0.1 * static_cast<double>(step) - joint;
        recording.truth[step].held.push_back({x, 2.0 * x, -3.0 * x});
      }
    }
    write_recording(recording, folder / "run.mpack");
    const Recording read = read_recording(folder / "run.mpack");
    EXPECT_EQ(read.truth.back().held.size(), static_cast<std::size_t>(count));
    expect_same(read, recording);
  }
  write_recording(sample_recording(5), folder / "none.mpack");
  EXPECT_EQ(read_file(folder / "none.mpack").find("held"), std::string::npos);
}

TEST(RoundTrip, KeepsMotorsOfClosedLegs) {
  const ScratchFolder folder;
  for (const std::size_t count : {1U, 2U, 4U}) {
    for (const bool has_truth : {true, false}) {
      Recording recording = sample_recording(5, has_truth);
      for (models::Observation& observation : recording.observation) {
        for (std::size_t i = 0; i < count; ++i) {
          const double x = observation.time - 0.3 * static_cast<double>(i);
          observation.motor.push_back({x, 2.0 * x, -3.0 * x});
        }
      }
      write_recording(recording, folder / "run.mpack");
      const Recording read = read_recording(folder / "run.mpack");
      EXPECT_EQ(read.observation.back().motor.size(), count);
      expect_same(read, recording);
    }
  }
  write_recording(sample_recording(5), folder / "none.mpack");
  EXPECT_EQ(read_file(folder / "none.mpack").find("motor"), std::string::npos);
}

TEST(RoundTrip, RecordingInMemoryIsReadLikeItsFile) {
  const ScratchFolder folder;
  for (const std::size_t steps : {0U, 5U}) {
    const auto recording = std::make_shared<Recording>(sample_recording(steps));
    for (models::GroundTruth& truth : recording->truth) {
      truth.held.push_back({0.1, 0.2, 0.3});
      truth.joint_torque.emplace().fill(0.5);
    }
    write_recording(*recording, folder / "run.mpack");
    LogReader reader(records_of(recording), "run");
    expect_same(read_recording(reader), read_recording(folder / "run.mpack"));
  }
}

TEST(RoundTrip, KeepsARunWithoutGroundTruthOrOutcome) {
  const ScratchFolder folder;
  Recording recording = sample_recording(3, false);
  recording.info.outcome.reset();
  recording.info.control_period_us = 2000;  // differs from its times on purpose
  write_recording(recording, folder / "run.mpack");
  expect_same(read_recording(folder / "run.mpack"), recording);
}

TEST(RoundTrip, KeepsATimeThatDoesNotBeginAtZero) {
  const ScratchFolder folder;
  Recording recording = sample_recording(4);
  for (models::Observation& observation : recording.observation) observation.time += 12.5;
  write_recording(recording, folder / "run.mpack");
  expect_same(read_recording(folder / "run.mpack"), recording);
}

TEST(RoundTrip, KeepsTheInfoOfARunWithoutSteps) {
  const ScratchFolder folder;
  Recording recording = sample_recording(0);
  recording.info.outcome = Outcome::diverged;
  write_recording(recording, folder / "run.mpack");
  expect_same(read_recording(folder / "run.mpack"), recording);
}

TEST(RoundTrip, KeepsEveryOutcome) {
  for (const Outcome outcome :
       {Outcome::finished, Outcome::timed_out, Outcome::fell, Outcome::diverged}) {
    EXPECT_EQ(outcome_from_text(to_text(outcome)), outcome);
  }
  EXPECT_THROW(outcome_from_text("exploded"), InputError);
}

TEST(RoundTrip, SameRecordingGivesTheSameBytes) {
  const ScratchFolder folder;
  write_recording(sample_recording(20), folder / "a.mpack");
  write_recording(sample_recording(20), folder / "b.mpack");
  EXPECT_EQ(read_file(folder / "a.mpack"), read_file(folder / "b.mpack"));
}

TEST(RoundTrip, StreamsRowByRow) {
  const Recording recording = sample_recording(5);
  std::stringstream stream;
  LogWriter writer(stream, recording.info, WrittenTruth{.of_robot = true});
  for (std::size_t i = 0; i < recording.steps(); ++i) {
    writer.write(recording.observation[i], recording.action[i], &recording.truth[i]);
  }
  writer.finish();
  LogReader reader(test::stream_source(stream), "stream");
  Recording back;
  back.info = reader.info();
  while (const auto row = reader.next()) {
    back.observation.push_back(row->observation);
    back.action.push_back(row->action);
    back.truth.push_back(row->truth.value());
  }
  expect_same(back, recording);
}

TEST(RoundTrip, ARowWithoutItsTruthIsRefused) {
  std::stringstream stream;
  LogWriter writer(stream, {}, WrittenTruth{.of_robot = true});
  EXPECT_THROW(writer.write({}, {}, nullptr), Error);
}

TEST(RoundTrip, ColumnsOfDifferentLengthsAreRefusedAndLeaveNoFile) {
  const ScratchFolder folder;
  Recording recording = sample_recording(4);
  recording.truth.pop_back();
  EXPECT_THROW(write_recording(recording, folder / "run.mpack"), Error);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(RoundTrip, AFullDiskIsAnError) {
  std::ofstream full("/dev/full", std::ios::binary);
  LogWriter writer(full, {}, WrittenTruth{});
  const auto write_much = [&] {
    for (int i = 0; i < 1000; ++i) writer.write({}, {}, nullptr);
  };
  EXPECT_THROW(write_much(), Error);
}

}  // namespace
}  // namespace touchdown::logs
