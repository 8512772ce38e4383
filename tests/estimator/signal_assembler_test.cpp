#include "estimator/signal_assembler.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/error.hpp"

namespace touchdown {
namespace {

constexpr double g = 9.81;
constexpr double pi = std::numbers::pi;

std::array<double, 4> wxyz(const Eigen::Quaterniond& q) { return {q.w(), q.x(), q.y(), q.z()}; }

/// Upkie upright: IMU x back, y left, z down; its reference x forward, y right, z down.
const std::array<double, 4> upright = {0.0, 0.0, 0.0, 1.0};

/// A robot that stands, with joints that differ from each other.
class Robot {
 public:
  explicit Robot(std::size_t joints = 6) : joints_(joints) {
    for (std::size_t i = 0; i < joints; ++i) {
      const auto n = static_cast<double>(i + 1);
      joints_[i] = {n, 10.0 * n, 100.0 * n};
    }
  }

  RobotRecord record(double time) {
    for (JointSignals& joint : joints_) joint.torque += 1e-6;  // servos never repeat themselves
    RobotRecord record;
    record.time = time;
    record.joints = joints_;
    record.orientation = upright;
    record.angular_velocity.setZero();
    record.linear_acceleration.setZero();
    record.proper_acceleration = {0.0, 0.0, -g};
    return record;
  }

  std::vector<JointSignals>& joints() { return joints_; }

 private:
  std::vector<JointSignals> joints_;
};

TEST(SignalsOfARecord, ConvertOrderSignsUnitsAndZeros) {
  Robot robot(8);
  AssemblyConfig config;
  config.joints = {{{7, -1.0, 0.5}, {6}, {5}, {4}, {3}, {2, -1.0}}};
  config.units = {.time = 1e-3, .position = pi / 180.0, .velocity = 2.0 * pi, .torque = 0.1};
  const RobotRecord record = robot.record(2500.0);
  const Signals signals = signals_of(record, config);
  EXPECT_DOUBLE_EQ(signals.time, 2.5);
  EXPECT_DOUBLE_EQ(signals.leg[0].hip.position, -(8.0 * pi / 180.0 - 0.5));
  EXPECT_DOUBLE_EQ(signals.leg[0].hip.velocity, -80.0 * 2.0 * pi);
  EXPECT_DOUBLE_EQ(signals.leg[0].hip.torque, -0.1 * record.joints[7].torque);
  EXPECT_DOUBLE_EQ(signals.leg[0].knee.torque, 0.1 * record.joints[6].torque);
  EXPECT_DOUBLE_EQ(signals.leg[1].wheel.velocity, -30.0 * 2.0 * pi);
}

TEST(SignalsOfARecord, FindTheVerticalInAnyAttitudeAndConvention) {
  const Eigen::Quaterniond attitude =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1.0, -2.0, 0.5).normalized()) *
      Eigen::Quaterniond(upright[0], upright[1], upright[2], upright[3]);
  for (const bool z_up : {false, true}) {
    Robot robot;
    RobotRecord record = robot.record(0.0);
    record.orientation = wxyz(attitude);
    const Eigen::Vector3d up(0.0, 0.0, z_up ? 1.0 : -1.0);
    AssemblyConfig config;
    config.reference_is_z_up = z_up;
    record.linear_acceleration = attitude.conjugate() * (3.0 * up);
    EXPECT_NEAR(signals_of(record, config).vertical_acceleration, 3.0, 1e-12);
    // The same from the chip's own measurement, in units of g.
    config.acceleration = AccelerationSource::proper;
    config.units.linear_acceleration = g;
    record.linear_acceleration.setConstant(not_reported);
    record.proper_acceleration = attitude.conjugate() * ((3.0 / g + 1.0) * up);
    EXPECT_NEAR(signals_of(record, config).vertical_acceleration, 3.0, 1e-9);
  }
}

/// A robot that rolls to its right while its IMU is mounted in other ways: the signals are those of
/// Upkie's mounting.
TEST(SignalsOfARecord, DoNotDependOnHowTheImuIsMounted) {
  const Eigen::Quaterniond attitude =
      Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX()) *
      Eigen::Quaterniond(upright[0], upright[1], upright[2], upright[3]);
  const Eigen::Vector3d rate(-0.7, 0.2, 0.1);  // x back: rolls to the right
  const Eigen::Vector3d acceleration(1.0, 2.0, 3.0);
  const Eigen::Matrix3d measured = (Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitZ()) *
                                    Eigen::AngleAxisd(-0.2, Eigen::Vector3d::UnitY()))
                                       .toRotationMatrix();
  const double vertical = upward(wxyz(attitude), acceleration);
  for (const Eigen::Matrix3d& axes :
       {signed_axes({"-x", "y", "-z"}), signed_axes({"y", "x", "-z"}), measured}) {
    Robot robot;
    RobotRecord record = robot.record(0.0);
    record.orientation = wxyz(attitude * Eigen::Quaterniond(axes));
    record.angular_velocity = axes.transpose() * rate;
    record.linear_acceleration = axes.transpose() * acceleration;
    AssemblyConfig config;
    config.axes = axes;
    const Signals signals = signals_of(record, config);
    EXPECT_TRUE(signals.angular_velocity.isApprox(rate, 1e-12)) << axes;
    EXPECT_TRUE(signals.linear_acceleration.isApprox(acceleration, 1e-12)) << axes;
    EXPECT_NEAR(signals.vertical_acceleration, vertical, 1e-12) << axes;
  }
}

TEST(SignalsOfARecord, KeepTheNumbersOfAnImuThatLosesOne) {
  Robot robot;
  RobotRecord record = robot.record(0.0);
  record.angular_velocity = {1.0, not_reported, 3.0};
  const Signals signals = signals_of(record, {});
  EXPECT_EQ(signals.angular_velocity.x(), 1.0);
  EXPECT_TRUE(std::isnan(signals.angular_velocity.y()));
}

TEST(SignedAxes, AreARightHandedOrderOrNothing) {
  EXPECT_TRUE(signed_axes({"x", "y", "z"}).isIdentity(0.0));
  for (const auto& names : std::vector<std::array<std::string_view, 3>>{
           {"-x", "y", "z"}, {"x", "x", "z"}, {"y", "x", "z"}, {"X", "y", "z"}, {"x", "y", ""}}) {
    EXPECT_TRUE(signed_axes(names).isZero()) << names[0] << names[1] << names[2];
  }
}

TEST(SignalsOfARecord, AreNanWhereNotReported) {
  Robot robot(3);
  const Signals signals = signals_of(robot.record(0.0), {});
  EXPECT_EQ(signals.leg[0].wheel.velocity, 30.0);
  EXPECT_TRUE(std::isnan(signals.leg[1].hip.torque));
  const Signals nothing = signals_of(RobotRecord{}, {});
  EXPECT_TRUE(std::isnan(nothing.time) && std::isnan(nothing.vertical_acceleration) &&
              std::isnan(nothing.leg[0].knee.position) && nothing.linear_acceleration.hasNaN());
}

TEST(SignalAssembler, FindsNoFaultInARobotThatStandsFallsAndLands) {
  SignalAssembler assembler;
  Robot robot;
  for (int k = 0; k < 3000; ++k) {
    RobotRecord record = robot.record(1e-3 * k);
    const double up = k % 1000 < 400 ? 0.0 : k % 1000 < 600 ? -g : k % 1000 < 620 ? 98.1 : 0.0;
    record.linear_acceleration = {0.0, 0.0, -up};
    record.proper_acceleration = {0.0, 0.0, -up - g};
    EXPECT_DOUBLE_EQ(assembler.assemble(record).vertical_acceleration, up);
    ASSERT_FALSE(assembler.faults().any()) << k << " " << assembler.faults().bits;
  }
}

/// The faults after half a second with this orientation, of a robot at rest.
RecordFaults faults_after_half_a_second(const std::array<double, 4>& orientation,
                                        bool chip_reports) {
  SignalAssembler assembler;
  Robot robot;
  for (int k = 0; k < 500; ++k) {
    RobotRecord record = robot.record(1e-3 * k);
    record.orientation = orientation;
    if (!chip_reports) {  // the robot removed gravity by the wrong orientation
      const Eigen::Quaterniond q(orientation[0], orientation[1], orientation[2], orientation[3]);
      record.linear_acceleration =
          record.proper_acceleration - q.conjugate() * Eigen::Vector3d(0.0, 0.0, -g);
      record.proper_acceleration.setConstant(not_reported);
    }
    assembler.assemble(record);
  }
  return assembler.faults();
}

TEST(SignalAssembler, DetectsAnUpsideDownImuByGravity) {
  for (const bool chip_reports : {true, false}) {
    EXPECT_FALSE(faults_after_half_a_second(upright, chip_reports).any());
    // Turned about y in place of z, and x y z w instead of w x y z.
    EXPECT_TRUE(faults_after_half_a_second({0.0, 0.0, 1.0, 0.0}, chip_reports)
                    .has(RecordFault::upside_down));
    EXPECT_TRUE(faults_after_half_a_second({0.0, 1.0, 0.0, 0.0}, chip_reports)
                    .has(RecordFault::upside_down));
  }
}

TEST(SignalAssembler, WithholdsTheAccelerationOfAnUpsideDownImu) {
  SignalAssembler assembler;
  Robot robot;
  double vertical = 0.0;
  for (int k = 0; k < 1000; ++k) {
    RobotRecord record = robot.record(1e-3 * k);
    record.orientation = {0.0, 0.0, 1.0, 0.0};
    vertical = assembler.assemble(record).vertical_acceleration;
  }
  EXPECT_TRUE(std::isnan(vertical));
  EXPECT_GT(assembler.count(RecordFault::upside_down), 700U);
  EXPECT_EQ(to_text(RecordFault::upside_down), "upside down");
}

TEST(SignalAssembler, ReportsAnInvalidOrientation) {
  SignalAssembler assembler;
  Robot robot;
  RobotRecord record = robot.record(0.0);
  record.orientation = {0.0, 0.0, 0.0, 0.0};
  EXPECT_TRUE(std::isnan(assembler.assemble(record).vertical_acceleration));
  EXPECT_TRUE(assembler.faults().has(RecordFault::orientation_missing));
}

TEST(SignalAssembler, ReportsMissingAndStaleServos) {
  SignalAssembler assembler;
  Robot robot;
  double knee = 0.0;
  for (int k = 0; k < 400; ++k) {
    const double before = robot.joints()[1].torque;
    RobotRecord record = robot.record(1e-3 * k);
    robot.joints()[1].torque = k < 100 ? robot.joints()[1].torque : before;  // hangs
    const Signals& signals = assembler.assemble(record);
    knee = signals.leg[0].knee.torque;
    EXPECT_EQ(std::isfinite(knee), k < 349) << k;
    EXPECT_TRUE(std::isfinite(signals.leg[1].knee.torque));
  }
  EXPECT_TRUE(assembler.faults().has(RecordFault::joint_stale));
  EXPECT_FALSE(assembler.faults().has(RecordFault::joint_missing));
  RobotRecord record = robot.record(0.4);
  robot.joints()[4].torque = std::nan("");
  assembler.assemble(record);
  EXPECT_TRUE(assembler.faults().has(RecordFault::joint_missing));
  EXPECT_EQ(assembler.count(RecordFault::joint_missing), 1U);
}

TEST(SignalAssembler, ReportsATorqueThatStopsAlone) {
  SignalAssembler assembler;
  Robot robot;
  for (int k = 0; k < 1000; ++k) {
    RobotRecord record = robot.record(1e-3 * k);
    for (JointSignals& joint : robot.joints()) {
      joint.velocity = std::cos(1e-3 * k);
      joint.torque = 1.0 + 0.1 * std::sin(100.0 * k);
    }
    if (k >= 700) robot.joints()[3].torque = 0.0;
    const Signals& signals = assembler.assemble(record);
    EXPECT_EQ(signals.leg[1].hip.torque, robot.joints()[3].torque) << "estimators leave it out";
  }
  EXPECT_TRUE(assembler.faults().has(RecordFault::signal_stopped));
  EXPECT_NEAR(static_cast<double>(assembler.count(RecordFault::signal_stopped)), 45.0, 15.0);
  EXPECT_EQ(assembler.count(RecordFault::joint_stale), 0U);
}

/// The orientation turns, and so does the gravity that is removed.
TEST(SignalAssembler, LeavesOutAnAccelerationThatStopsBeforeGravityIsRemoved) {
  for (const bool stops : {false, true}) {
    AssemblyConfig config;
    config.acceleration = AccelerationSource::proper;
    SignalAssembler assembler(config);
    Robot robot;
    Signals signals;
    for (int k = 0; k < 1000; ++k) {
      RobotRecord record = robot.record(1e-3 * k);
      record.angular_velocity = Eigen::Vector3d::Random();
      record.orientation = wxyz(Eigen::AngleAxisd(1e-4 * k, Eigen::Vector3d::UnitX()) *
                                Eigen::Quaterniond(upright[0], upright[1], upright[2], upright[3]));
      record.proper_acceleration += 0.1 * Eigen::Vector3d::Random();
      if (stops && k >= 600) record.proper_acceleration.z() = -g;
      signals = assembler.assemble(record);
      EXPECT_FALSE(k < 800 && assembler.faults().has(RecordFault::signal_stopped)) << k;
    }
    EXPECT_EQ(assembler.faults().has(RecordFault::signal_stopped), stops);
    EXPECT_EQ(std::isnan(signals.vertical_acceleration), stops);
  }
}

TEST(SignalAssembler, ReportsFaultsOfTheClock) {
  SignalAssembler assembler;
  Robot robot;
  const auto faults_at = [&](double time) {
    assembler.assemble(robot.record(time));
    return assembler.faults();
  };
  EXPECT_FALSE(faults_at(100.0).any());
  EXPECT_TRUE(faults_at(99.9).has(RecordFault::clock_back));
  EXPECT_FALSE(faults_at(99.901).any());
  EXPECT_TRUE(faults_at(99.95).has(RecordFault::clock_gap));
  EXPECT_TRUE(faults_at(std::nan("")).has(RecordFault::clock_missing));
  EXPECT_FALSE(faults_at(99.952).any());  // the previous time was missing, the clock did not jump
}

TEST(SignalAssembler, ReportsAnotherRateThanConfigured) {
  for (const double rate : {500.0, 980.0, 1000.0, 1030.0, 2000.0}) {
    SignalAssembler assembler;
    Robot robot;
    for (int k = 0; k < 600; ++k) assembler.assemble(robot.record(k / rate));
    const bool is_other = std::abs(rate - 1000.0) > 50.0;
    EXPECT_EQ(assembler.faults().has(RecordFault::clock_rate), is_other) << rate;
  }
}

TEST(SignalAssembler, ClearsItsStateOnReset) {
  SignalAssembler assembler;
  Robot robot;
  RobotRecord record = robot.record(5.0);
  record.orientation = {0.0, 0.0, 1.0, 0.0};
  for (int k = 0; k < 1000; ++k) assembler.assemble(record);
  ASSERT_TRUE(assembler.faults().any());
  assembler.reset();
  EXPECT_EQ(assembler.count(RecordFault::upside_down), 0U);
  assembler.assemble(robot.record(1.0));
  EXPECT_FALSE(assembler.faults().any());
}

TEST(SignalAssembler, RefusesInvalidValues) {
  const auto refuses = [](auto change) {
    AssemblyConfig config;
    change(config);
    EXPECT_THROW(SignalAssembler{config}, InputError);
  };
  refuses([](AssemblyConfig& c) { c.sample_rate = 0.0; });
  refuses([](AssemblyConfig& c) { c.units.torque = -1.0; });
  refuses([](AssemblyConfig& c) { c.joints[3].sign = 0.5; });
  refuses([](AssemblyConfig& c) { c.joints[3].zero = HUGE_VAL; });
  refuses([](AssemblyConfig& c) { c.stale_after = -1.0; });
  refuses([](AssemblyConfig& c) { c.gravity_memory = 0.0; });
}

TEST(SignalsOfARecord, ConvertTargetsAsTheJoints) {
  Robot robot(8);
  RobotRecord record = robot.record(0.0);
  std::vector<JointTarget> targets(8);
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const auto n = static_cast<double>(i + 1);
    targets[i] = {n, 10.0 * n, 100.0 * n, 2.0 * n, 3.0 * n};
  }
  record.targets = targets;
  AssemblyConfig config;
  config.joints = {{{7, -1.0, 0.5}, {6}, {5}, {4}, {3}, {2, -1.0}}};
  config.units = {
      .position = pi / 180.0, .velocity = 2.0 * pi, .torque = 0.1, .kp = 20.0, .kd = 0.5};
  const Signals signals = signals_of(record, config);
  const JointTarget& hip = signals.target[0].hip;
  EXPECT_DOUBLE_EQ(hip.position, -(8.0 * pi / 180.0 - 0.5));
  EXPECT_DOUBLE_EQ(hip.velocity, -80.0 * 2.0 * pi);
  EXPECT_DOUBLE_EQ(hip.feedforward_torque, -80.0);
  EXPECT_DOUBLE_EQ(hip.kp, 320.0);  // gains have no sign
  EXPECT_DOUBLE_EQ(hip.kd, 12.0);
  EXPECT_DOUBLE_EQ(signals.target[1].wheel.velocity, -30.0 * 2.0 * pi);
  // Fewer targets than joints, or none: NaN, and no fault of the record.
  record.targets = std::span(targets).first(7);
  EXPECT_TRUE(std::isnan(signals_of(record, config).target[0].hip.kp));
  EXPECT_FALSE(std::isnan(signals_of(record, config).target[0].knee.kp));
  record.targets = {};
  EXPECT_TRUE(std::isnan(signals_of(record, config).target[0].knee.position));
  SignalAssembler assembler(AssemblyConfig{});
  EXPECT_FALSE(assembler.assemble(record).target[0].hip.kp > 0.0);
  EXPECT_FALSE(assembler.faults().any());
}

}  // namespace
}  // namespace touchdown
