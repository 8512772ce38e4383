#include <cmath>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "logs/log/reader.hpp"
#include "tests/logs/log/upkie_log.hpp"

namespace touchdown::logs {
namespace {

using nlohmann::json;
using test::pack;
using test::upkie_record;

std::vector<LogRow> rows(const std::vector<json>& records) {
  std::istringstream stream(pack(records));
  LogReader reader(test::stream_source(stream), "log");
  std::vector<LogRow> all;
  while (const auto row = reader.next()) all.push_back(*row);
  return all;
}

void add_truth(json& record, const char* root) {
  json& sim = record["observation"][root];
  sim["base"] = {{"position", {1.0, 2.0, 3.0}},
                 {"orientation", {0.5, 0.5, 0.5, -0.5}},
                 {"linear_velocity", {4.0, 5.0, 6.0}},
                 {"angular_velocity", {7.0, 8.0, 9.0}}};
  sim["imu"]["linear_velocity"] = {10.0, 11.0, 12.0};
}

void expect_truth(const LogRow& row) {
  ASSERT_TRUE(row.truth.has_value());
  EXPECT_EQ(row.truth->base_position, Eigen::Vector3d(1.0, 2.0, 3.0));
  EXPECT_EQ(row.truth->base_orientation.w(), 0.5);
  EXPECT_EQ(row.truth->base_orientation.z(), -0.5);
  EXPECT_EQ(row.truth->base_linear_velocity, Eigen::Vector3d(4.0, 5.0, 6.0));
  EXPECT_EQ(row.truth->base_angular_velocity, Eigen::Vector3d(7.0, 8.0, 9.0));
  EXPECT_EQ(row.truth->imu_linear_velocity, Eigen::Vector3d(10.0, 11.0, 12.0));
}

TEST(LogVersions, ReadsARobotsLog) {
  const auto log = rows({upkie_record(0.0), upkie_record(0.001)});
  ASSERT_EQ(log.size(), 2U);
  const models::Observation& o = log[1].observation;
  EXPECT_NEAR(o.time, 0.001, 1e-12);
  EXPECT_EQ(log[0].observation.time, 0.0);
  EXPECT_DOUBLE_EQ(o.servo[models::index(models::Servo::left_wheel)].position, 0.3);
  EXPECT_DOUBLE_EQ(o.servo[models::index(models::Servo::right_knee)].torque, 1.0);
  EXPECT_DOUBLE_EQ(o.servo[models::index(models::Servo::right_wheel)].velocity, 1.8);
  EXPECT_EQ(o.imu.orientation.y(), 1.0);
  EXPECT_EQ(o.imu.angular_velocity, Eigen::Vector3d(0.1, 0.2, 0.3));
  EXPECT_EQ(o.imu.linear_acceleration, Eigen::Vector3d(1.0, 2.0, 3.0));
  EXPECT_EQ(o.imu.raw_linear_acceleration, Eigen::Vector3d(1.0, 2.0, -7.0));
  EXPECT_EQ(o.pitch, 0.05);
  EXPECT_EQ(o.pitch_rate, 0.02);
  const models::ServoCommand& command =
      log[0].action.servo[models::index(models::Servo::left_knee)];
  EXPECT_TRUE(std::isnan(command.position)) << "a null position is no position";
  EXPECT_EQ(command.velocity, 2.0);
  EXPECT_EQ(command.kp_scale, 0.5);
  EXPECT_EQ(command.maximum_torque, 1.7);
  EXPECT_FALSE(log[0].truth.has_value());
}

TEST(LogVersions, Before51TruthIsUnderBulletWithContactPointsPerLink) {
  json record = upkie_record(0.0);
  add_truth(record, "bullet");
  record["observation"]["bullet"]["contact"] = {{"left_wheel_tire", {{"num_contact_points", 2}}},
                                                {"right_wheel_tire", {{"num_contact_points", 0}}}};
  const auto log = rows({record});
  expect_truth(log.at(0));
  EXPECT_GT(log[0].truth->wheel_normal_force[0], 1e9) << "in contact, by an unknown force";
  EXPECT_EQ(log[0].truth->wheel_normal_force[1], 0.0);
}

TEST(LogVersions, Before51ThereAreNoRawReadings) {
  json record = upkie_record(0.0);
  record["observation"]["imu"].erase("raw_linear_acceleration");
  record["observation"]["imu"].erase("raw_angular_velocity");
  const auto log = rows({record});
  // Upright (half a turn about the IMU's y axis): gravity removed, the chip feels 9.81 upwards,
  // which is −z in the world's upside-down reference and +z of an IMU that is turned about y.
  EXPECT_TRUE(log.at(0).observation.imu.raw_linear_acceleration.isApprox(
      Eigen::Vector3d(1.0, 2.0, 3.0 + 9.81), 1e-12));
}

TEST(LogVersions, From52TruthIsUnderSimAndContactMayBeUnknown) {
  json record = upkie_record(0.0);
  add_truth(record, "sim");
  record["observation"]["sim"]["bodies"]["torso"]["position"] = {0, 0, 0};
  const auto log = rows({record});
  expect_truth(log.at(0));
  EXPECT_TRUE(std::isnan(log[0].truth->wheel_normal_force[0]));
}

TEST(LogVersions, From70ContactGroupsAreIntegers) {
  json record = upkie_record(0.0);
  add_truth(record, "sim");
  record["observation"]["sim"]["contact"] = {{"left_wheel", 0}, {"right_wheel", 1}};
  const auto log = rows({record});
  EXPECT_EQ(log.at(0).truth->wheel_normal_force[0], 0.0);
  EXPECT_GT(log[0].truth->wheel_normal_force[1], 1e9);
}

TEST(LogVersions, Before101ThereIsNoBaseRotation) {
  json record = upkie_record(0.0);
  record["observation"]["base_orientation"].erase("rotation_base_to_world");
  EXPECT_EQ(rows({record}).size(), 1U);
}

TEST(LogVersions, PitchAndYawComeFromTheImuWhereAbsent) {
  json record = upkie_record(0.0);
  record["observation"].erase("base_orientation");
  // World from base: yaw 0.4, then pitch 0.3. The IMU is the base turned half a turn about y, the
  // reference system is the world turned half a turn about x.
  const Eigen::Quaterniond base(Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitZ()) *
                                Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY()));
  const Eigen::Quaterniond half_y(0.0, 0.0, 1.0, 0.0);
  const Eigen::Quaterniond half_x(0.0, 1.0, 0.0, 0.0);
  const Eigen::Quaterniond imu = half_x * base * half_y;
  record["observation"]["imu"]["orientation"] = {imu.w(), imu.x(), imu.y(), imu.z()};
  const Eigen::Vector3d world_rate(0.0, 0.0, 0.7);
  const Eigen::Vector3d imu_rate = imu.conjugate() * (half_x * world_rate);
  record["observation"]["imu"]["angular_velocity"] = {imu_rate.x(), imu_rate.y(), imu_rate.z()};
  const auto log = rows({record});
  EXPECT_NEAR(log.at(0).observation.pitch, 0.3, 1e-12);
  EXPECT_NEAR(log[0].observation.yaw, 0.4, 1e-12);
  EXPECT_NEAR(log[0].observation.pitch_rate, 0.0, 1e-12);
  EXPECT_NEAR(log[0].observation.yaw_rate, 0.7, 1e-12);
}

TEST(LogVersions, ALogWithoutActionsOrObservationTimeIsRead) {
  json record = upkie_record(0.25);
  record.erase("action");
  record["observation"].erase("time");
  const auto log = rows({upkie_record(0.0), record});
  EXPECT_EQ(log.at(1).action.servo[0].kp_scale, 1.0);
  json first = upkie_record(0.0);
  first["observation"].erase("time");
  EXPECT_NEAR(rows({first, record}).at(1).observation.time, 0.25, 1e-6);
}

TEST(LogVersions, PeriodIsTheMedianDifferenceAndTakesNoRowAway) {
  for (const double rate : {200.0, 400.0, 1000.0}) {
    std::vector<json> records;
    double time = 0.0;
    for (int i = 0; i < 300; ++i) {
      records.push_back(upkie_record(time));
      time += (i % 10 == 3 ? 2.7 : i % 2 == 0 ? 1.00001 : 0.99999) / rate;  // a late cycle, jitter
    }
    std::istringstream stream(pack(records));
    LogReader reader(test::stream_source(stream), "log");
    EXPECT_NEAR(1e-6 * static_cast<double>(reader.info().control_period_us), 1.0 / rate, 1.1e-6);
    std::size_t count = 0;
    double last = -1.0;
    while (const auto row = reader.next()) {
      EXPECT_GT(row->observation.time, last);
      last = row->observation.time;
      ++count;
    }
    EXPECT_EQ(count, 300U);
  }
}

}  // namespace
}  // namespace touchdown::logs
