#include <bit>
#include <cmath>
#include <set>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/fields.hpp"
#include "core/resources.hpp"
#include "noise/reported_signals.hpp"
#include "tests/noise/observations.hpp"

namespace touchdown::noise {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr NoiseKey report_key{42, 3};
constexpr double report_period = 0.001;
const Eigen::Vector3d gravity(0.0, 0.0, 9.81);  // in the attitude reference system: z down

/// A tumbling robot with all joints in motion.
Steps tumbling(std::size_t steps) {
  Steps run(steps);
  for (std::size_t k = 0; k < steps; ++k) {
    const double t = report_period * static_cast<double>(k);
    models::Observation& o = run[k];
    o.time = t;
    for (std::size_t j = 0; j < models::servo_count; ++j) {
      const auto phase = static_cast<double>(j);
      o.servo[j] = {std::sin(3.0 * t + phase) + 5.0 * t, std::cos(2.0 * t + phase),
                    0.1 * phase + t};
    }
    models::ImuReading& imu = o.imu;
    imu.orientation = Eigen::AngleAxisd(2.0 * t, Eigen::Vector3d(1.0, 2.0, -0.5).normalized());
    imu.angular_velocity = {0.3, std::sin(t), -0.2};
    imu.linear_acceleration = {std::sin(9.0 * t), 2.0, std::cos(30.0 * t)};
    imu.raw_linear_acceleration = imu.linear_acceleration - imu.orientation.conjugate() * gravity;
    o.pitch = 0.1 * t;
    o.yaw = 0.2 * t;
  }
  return run;
}

SensorProfile profile_of(const std::string& text) {
  return from_yaml<SensorProfile>(YamlDocument::parse(text, "s.yaml"));
}

Steps reported(const SensorProfile& profile, Steps run, const NoiseKey& of = report_key) {
  report_through(profile, of, report_period, run);
  return run;
}

Steps reported(const std::string& text, Steps run) {
  return reported(profile_of(text), std::move(run));
}

/// All disturbances on every sensor.
const std::string everything =
    "{scale: {sd: 0.1}, bias: {value: 0.1, sd: 0.1, walk: 0.1},"
    " coloured: {sd: 0.1, time_constant: 0.1}, low_pass: {cut_off: 50}, white: 0.1, range: 20,"
    " resolution: 0.001, rate: 400, delay: 0.003, dropout: {rate: 0.05}}\n";
const std::string all_sensors =
    "torque: " + everything + "position: " + everything + "velocity: " + everything +
    "accelerometer: " + everything + "gyroscope: " + everything +
    "orientation: {bias: {sd: 0.1}, white: 0.01, rate: 400}\nmisalignment: {sd: 0.1}\n";

TEST(Reported, IdealSensorsReportWhatIsRecordedToTheBit) {
  Steps run = tumbling(200);
  run[7].servo[2].torque = -0.0;
  run[8].imu.linear_acceleration.x() = -0.0;
  EXPECT_THAT(different(reported(SensorProfile(), run), run), IsEmpty());
  EXPECT_THAT(different(reported(find_sensor_profile("noise/profiles/ideal.yaml"), run), run),
              IsEmpty());
}

TEST(Reported, TheRightLegsJointsComeLaterByTheSkewThanTheLeftOnes) {
  const Steps run = tumbling(100);
  const Steps late = reported("leg_skew: 0.004\ntorque: {delay: 0.002}\n", run);
  for (std::size_t k = 6; k < run.size(); ++k) {
    for (std::size_t joint = 0; joint < 3; ++joint) {
      const std::size_t right = joint + 3;
      ASSERT_EQ(late[k].servo[joint].torque, run[k - 2].servo[joint].torque);
      ASSERT_EQ(late[k].servo[right].torque, run[k - 6].servo[right].torque);
      ASSERT_EQ(late[k].servo[joint].position, run[k].servo[joint].position);
      ASSERT_EQ(late[k].servo[right].position, run[k - 4].servo[right].position);
      ASSERT_EQ(late[k].servo[right].velocity, run[k - 4].servo[right].velocity);
    }
    ASSERT_EQ(late[k].imu.angular_velocity, run[k].imu.angular_velocity);
  }
}

TEST(Reported, EverySensorOfTheProfileChangesItsOwnNumbersOnly) {
  const Steps run = tumbling(50);
  const auto changed = [&](const std::string& text) { return different(reported(text, run), run); };
  EXPECT_THAT(changed("torque: {hip: {white: 1}}"),
              ElementsAre("left_hip torque", "right_hip torque"));
  EXPECT_THAT(changed("torque: {knee: {white: 1}}"),
              ElementsAre("left_knee torque", "right_knee torque"));
  EXPECT_THAT(changed("position: {wheel: {white: 1}}"),
              ElementsAre("left_wheel position", "right_wheel position"));
  EXPECT_THAT(changed("velocity: {hip: {bias: {sd: 1}}}"),
              ElementsAre("left_hip velocity", "right_hip velocity"));
  EXPECT_THAT(changed("gyroscope: {y: {white: 1}}"), ElementsAre("gyro y"));
  EXPECT_THAT(changed("accelerometer: {white: 1}"),
              ElementsAre("linear x", "linear y", "linear z", "raw x", "raw y", "raw z"));
  EXPECT_THAT(changed("orientation: {white: 1}"),
              ElementsAre("attitude", "linear x", "linear y", "linear z"));
}

TEST(Reported, AChannelMoreChangesNoOtherChannelsDraws) {
  const Steps run = tumbling(400);
  const Steps alone = reported("torque: {knee: " + everything + "}", run);
  const Steps together = reported(all_sensors, run);
  for (std::size_t k = 0; k < run.size(); ++k) {
    const std::size_t knee = models::index(models::Servo::left_knee);
    EXPECT_EQ(alone[k].servo[knee].torque, together[k].servo[knee].torque) << k;
  }
}

TEST(Reported, ARunInPartsIsReportedAsTheWholeRunToTheBit) {
  const Steps run = tumbling(700);
  const std::string vibrating =
      "torque: {wheel: {rate: 300, delay: 0.005,"
      " dropout: {kind: frozen, rate: 0.02, length: 0.01}}}\n"
      "accelerometer: {white: 1, vibration: {amplitude: 0.2, order: 3}, dropout: {kind: nan, rate: "
      "0.02}}\n"
      "orientation: {delay: 0.002, white: 0.01}\n";
  for (const SensorProfile& profile : {profile_of(all_sensors), profile_of(vibrating),
                                       profile_of("misalignment: {sd: 0.1}\n"), SensorProfile()}) {
    const Steps whole = reported(profile, run);
    for (const std::size_t length : {1U, 7U, 64U, 699U}) {
      Steps parts = run;
      ReportingSensors sensors(profile, report_key, report_period);
      for (std::size_t k = 0; k < parts.size(); k += length) {
        sensors.report(std::span(parts).subspan(k, std::min(length, parts.size() - k)));
      }
      EXPECT_THAT(different(parts, whole), IsEmpty()) << length;
    }
  }
  Steps longer = reported(all_sensors, tumbling(900));  // begins as the shorter run
  longer.resize(700);
  EXPECT_THAT(different(longer, reported(all_sensors, run)), IsEmpty());
  EXPECT_TRUE(reported(all_sensors, Steps()).empty());
}

/// Zero torque of a knee as reported through a channel.
std::vector<double> knee_torque(const std::string& channel, std::size_t steps) {
  std::vector<double> values;
  for (const auto& o : reported("torque: " + channel, Steps(steps))) {
    values.push_back(o.servo[models::index(models::Servo::left_knee)].torque);
  }
  return values;
}

TEST(Reported, DisturbancesTogetherAreTheSumOfEachAlone) {
  const auto torque = [](const std::string& channel) { return knee_torque(channel, 300); };
  const auto all = torque("{white: 0.5, coloured: {sd: 1.0}, bias: {sd: 1.0, walk: 0.2}}");
  const auto white = torque("{white: 0.5}"), coloured = torque("{coloured: {sd: 1.0}}");
  const auto bias = torque("{bias: {sd: 1.0}}"), walk = torque("{bias: {walk: 0.2}}");
  for (std::size_t k = 0; k < all.size(); ++k) {
    EXPECT_NEAR(all[k], white[k] + coloured[k] + bias[k] + walk[k], 1e-12);
  }
}

TEST(Reported, EveryNumberOfEverySensorHasDrawsOfItsOwn) {
  const std::string white = "{white: 1.0}\n";
  const Steps all = reported("torque: " + white + "position: " + white + "velocity: " + white +
                                 "accelerometer: " + white + "gyroscope: " + white,
                             Steps(1));
  std::set<double> draws;
  for (const auto& [name, number] : numbers(all.front())) {
    if (number == 0.0 || name.starts_with("linear") || name == "attitude") continue;
    EXPECT_TRUE(draws.insert(number).second) << name;
  }
  EXPECT_EQ(draws.size(), 3 * models::servo_count + 6U);
}

TEST(Reported, IsTheSameInWhateverOrderAndInHoweverManyThreadsRunsAreReported) {
  const SensorProfile profile = profile_of(all_sensors);
  const Steps run = tumbling(300);
  std::vector<Steps> in_turn, whole_run(8);
  for (std::uint64_t i = 0; i < 8; ++i) in_turn.push_back(reported(profile, run, {1, i}));
  std::vector<std::thread> threads;
  for (std::uint64_t i = 8; i-- > 0;) {
    threads.emplace_back([&, i] { whole_run[i] = reported(profile, run, {1, i}); });
  }
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_THAT(different(in_turn[i], whole_run[i]), IsEmpty());
    EXPECT_THAT(different(in_turn[i], in_turn[(i + 1) % 8]), ::testing::Not(IsEmpty()));
  }
}

// The accelerometer, with and without gravity.

/// Gravity according to the report of a step, in the attitude reference system.
Eigen::Vector3d gravity_in(const models::ImuReading& imu) {
  return imu.orientation * (imu.linear_acceleration - imu.raw_linear_acceleration);
}

TEST(ReportedGravity, IsTakenAwayAlongTheReportedOrientationWhateverIsWrong) {
  const Steps run = tumbling(300);
  for (const char* text :
       {"misalignment: {roll: 0.1, pitch: -0.2, yaw: 0.3}", "orientation: {bias: {value: 0.1}}",
        "accelerometer: {white: 1.0, bias: {value: 0.5}}",
        "orientation: {white: 0.1, rate: 100, delay: 0.01}\naccelerometer: {range: 9}"}) {
    for (const models::Observation& o : reported(text, run)) {
      ASSERT_TRUE(gravity_in(o.imu).isApprox(gravity, 1e-12)) << text;
      ASSERT_NEAR(o.imu.orientation.norm(), 1.0, 1e-12);
    }
  }
}

TEST(ReportedGravity, OfAMisalignedImuTurnsWithAllOfIt) {
  const Steps run = tumbling(300);
  const Steps turned = reported("misalignment: {roll: 0.1, pitch: -0.2, yaw: 0.3}", run);
  const Eigen::Quaterniond mounting = Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()) *
                                      Eigen::AngleAxisd(-0.2, Eigen::Vector3d::UnitY()) *
                                      Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitX());
  for (std::size_t k = 0; k < run.size(); ++k) {
    const models::ImuReading &was = run[k].imu, &is = turned[k].imu;
    EXPECT_TRUE(
        (mounting * is.raw_linear_acceleration).isApprox(was.raw_linear_acceleration, 1e-12));
    EXPECT_TRUE((mounting * is.angular_velocity).isApprox(was.angular_velocity, 1e-12));
    EXPECT_TRUE((mounting * is.linear_acceleration).isApprox(was.linear_acceleration, 1e-11));
    // The misaligned IMU reports its own attitude, so the vertical acceleration is right.
    EXPECT_NEAR(models::vertical_acceleration(is), models::vertical_acceleration(was), 1e-11);
  }
}

TEST(ReportedGravity, LeaksIntoTheAccelerationIfTheAttitudeIsWrong) {
  Steps still(10);
  for (auto& o : still) o.imu.raw_linear_acceleration = -gravity;
  for (const auto& o : reported("orientation: {x: {bias: {value: 0.1}}}", still)) {
    // Half of the angle's tangent is half the angle here: the rotation is 2·atan(0.05).
    const double angle = 2.0 * std::atan(0.05);
    EXPECT_NEAR(o.imu.linear_acceleration.y(), 9.81 * std::sin(angle), 1e-12);
    EXPECT_NEAR(models::vertical_acceleration(o.imu), -9.81 * (1.0 - std::cos(angle)), 1e-12);
  }
}

TEST(ReportedGravity, CountsForTheRangeOfTheAccelerometer) {
  Steps falling(3);
  for (auto& o : falling) o.imu.linear_acceleration = gravity;  // and no proper acceleration
  Steps standing(3);
  for (auto& o : standing) o.imu.raw_linear_acceleration = -gravity;
  const std::string range = "accelerometer: {range: 5}";
  EXPECT_NEAR(reported(range, falling)[1].imu.linear_acceleration.z(), 9.81, 1e-12);
  EXPECT_NEAR(reported(range, standing)[1].imu.linear_acceleration.z(), 4.81, 1e-12);
}

TEST(ReportedVibration, FollowsTheWheelThatTurnsAndNotItsEncodersReport) {
  Steps run(1'000);
  for (std::size_t k = 0; k < run.size(); ++k) {
    const double t = report_period * static_cast<double>(k);
    run[k].servo[models::index(models::Servo::left_wheel)] = {20.0 * t, 20.0, 0.0};
  }
  const std::string shaking = "gyroscope: {x: {vibration: {amplitude: 0.1, order: 2}}}\n";
  const Steps shaken = reported(shaking, run);
  // x'' = −(2·20)²·x for a sine of twice the wheel's frequency.
  double largest = 0.0;
  for (std::size_t k = 1; k + 1 < run.size(); ++k) {
    const auto x = [&](std::size_t i) { return shaken[i].imu.angular_velocity.x(); };
    EXPECT_NEAR((x(k + 1) - 2.0 * x(k) + x(k - 1)) / (report_period * report_period),
                -1'600.0 * x(k), 1.0);
    largest = std::max(largest, std::abs(x(k)));
  }
  EXPECT_NEAR(largest, 2.0, 0.01);
  const Steps frozen = reported(shaking + "position: {rate: 1}\nvelocity: {rate: 1}\n", run);
  for (std::size_t k = 0; k < run.size(); ++k) {
    EXPECT_EQ(frozen[k].imu.angular_velocity, shaken[k].imu.angular_velocity);
  }
}

TEST(ReportedDropouts, OfAnImuTakeAllOfItsAxesAtOnceAndAreNotThoseOfAnotherSensor) {
  const Steps run = tumbling(2'000);
  const Steps with = reported(
      "accelerometer: {dropout: {kind: nan, rate: 0.02}}\n"
      "gyroscope: {dropout: {kind: nan, rate: 0.02}}\n",
      run);
  std::size_t apart = 0, dropped = 0;
  for (const auto& o : with) {
    const bool is_dropped = std::isnan(o.imu.raw_linear_acceleration.x());
    EXPECT_EQ(o.imu.raw_linear_acceleration.hasNaN(), is_dropped);
    EXPECT_EQ(o.imu.raw_linear_acceleration.array().isNaN().all(), is_dropped);
    EXPECT_EQ(o.imu.linear_acceleration.array().isNaN().all(), is_dropped);
    dropped += is_dropped ? 1 : 0;
    apart += is_dropped != o.imu.angular_velocity.hasNaN() ? 1 : 0;
  }
  EXPECT_GT(dropped, 100U);
  EXPECT_GT(apart, 100U);
}

TEST(ReportedDropouts, OfAFrozenOrientationRepeatIt) {
  const Steps run = tumbling(2'000);
  const Steps with = reported("orientation: {dropout: {kind: frozen, rate: 0.02}}", run);
  std::size_t repeated = 0;
  for (std::size_t k = 1; k < run.size(); ++k) {
    const Eigen::Vector4d is = with[k].imu.orientation.coeffs();
    if (is == with[k - 1].imu.orientation.coeffs()) {
      ++repeated;
    } else {
      EXPECT_TRUE(is.isApprox(run[k].imu.orientation.coeffs(), 1e-15));
    }
  }
  // r·L/(r·L + 1 − r) with mean lengths of 10 steps.
  EXPECT_NEAR(static_cast<double>(repeated) / 2'000.0, 0.2 / (0.2 + 0.98), 0.08);
}

TEST(ReportedDropouts, OfAMissingRecordLeaveNoNumberOfTheStep) {
  const Steps run = tumbling(2'000);
  const Steps with = reported("torque: {knee: {dropout: {kind: missing, rate: 0.01}}}", run);
  std::size_t missing = 0;
  for (std::size_t k = 0; k < run.size(); ++k) {
    if (!std::isnan(with[k].time)) {
      EXPECT_THAT(different({run[k]}, {with[k]}), IsEmpty());
      continue;
    }
    ++missing;
    for (const auto& [name, number] : numbers(with[k])) EXPECT_TRUE(std::isnan(number)) << name;
  }
  EXPECT_GT(missing, 50U);
  EXPECT_LT(missing, 1'000U);
}

TEST(ReportTargets, KeepTheTrackingErrorOfTheServos) {
  // Zero errors of joints move positions and targets alike, drawn or given, on every joint.
  for (const char* text : {"position: {hip: {bias: {sd: 0.02}}, knee: {bias: {sd: 0.02}}}",
                           "position: {bias: {value: 0.3, sd: 0.1}}", "torque: {white: 0.1}"}) {
    const SensorProfile profile = profile_of(text);
    const Steps ideal = tumbling(5);
    const Steps seen = reported(profile, ideal);
    std::vector<models::Action> actions(ideal.size());
    for (std::size_t k = 0; k < actions.size(); ++k) {
      for (std::size_t i = 0; i < models::servo_count; ++i) {
        actions[k].servo[i] = {0.1, ideal[k].servo[i].position + 0.05, 0.2, 2.0, 0.3, 4.0};
      }
      actions[k].servo[2].position = std::nan("");
    }
    std::vector<models::Action> shifted = actions;
    report_targets(profile, report_key, shifted);
    for (std::size_t k = 0; k < actions.size(); ++k) {
      for (std::size_t i = 0; i < models::servo_count; ++i) {
        const models::ServoCommand& command = shifted[k].servo[i];
        if (i == 2) {
          EXPECT_TRUE(std::isnan(command.position));
        } else {
          EXPECT_NEAR(command.position - seen[k].servo[i].position, 0.05, 1e-12) << text;
        }
        EXPECT_EQ(command.velocity, 0.2);
        EXPECT_EQ(command.feedforward_torque, 0.1);
        EXPECT_EQ(command.kp_scale, 2.0);
      }
    }
  }
}

}  // namespace
}  // namespace touchdown::noise
