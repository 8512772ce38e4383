#include "estimator/force/linkage.hpp"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "estimator/force/closed_legs.hpp"
#include "tests/complaint.hpp"

namespace touchdown {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

constexpr double crank_length = 0.15, rod_length = 0.28, motor_spacing = 0.1;  // m

/// The virtual leg of a symmetric five-bar in closed form. Angles are positive forward, from
/// straight down; the knee of the front crank is that of the virtual leg.
struct FiveBar {
  Vector2d front_knee, rear_knee, axle;
  double hip, knee;
  Matrix2d leg;  ///< hip and knee per front and rear motor

  FiveBar(double front, double rear) {
    const Vector2d t1 = crank_length * Vector2d(std::cos(front), std::sin(front));
    const Vector2d t2 = crank_length * Vector2d(std::cos(rear), std::sin(rear));
    front_knee = {motor_spacing / 2 + t1.y(), -t1.x()};
    rear_knee = {-motor_spacing / 2 + t2.y(), -t2.x()};
    const Vector2d across = front_knee - rear_knee;
    const double height = std::sqrt(rod_length * rod_length - across.squaredNorm() / 4);
    axle =
        (front_knee + rear_knee) / 2 + height / across.norm() * Vector2d(across.y(), -across.x());
    const Vector2d r1 = axle - front_knee, r2 = axle - rear_knee;
    hip = front;
    knee = std::atan2(r1.x(), -r1.y()) - front;
    Matrix2d rods, by_leg;
    rods << r1.transpose(), r2.transpose();
    by_leg << t1.x() - r1.y(), -r1.y(), t1.y() + r1.x(), r1.x();
    leg =
        by_leg.inverse() * rods.inverse() * Matrix2d(Vector2d(r1.dot(t1), r2.dot(t2)).asDiagonal());
  }
};

Linkage five_bar() {
  const FiveBar at(0.6, -0.7);
  const Vector2d rear_rod = at.axle - at.rear_knee;
  Linkage linkage;
  linkage.hinges = {{-1, {motor_spacing / 2, 0.0}, -1.0, at.hip},
                    {0, at.front_knee, -1.0, at.knee},
                    {-1, {-motor_spacing / 2, 0.0}, -1.0, -0.7},
                    {2, at.rear_knee, -1.0, std::atan2(rear_rod.x(), -rear_rod.y()) + 0.7}};
  linkage.loops = {{{1, at.axle}, {3, at.axle}}};
  linkage.motors = {0, 2};
  linkage.branch = {{0.4, {2, 0.5 * at.rear_knee}}, {0.3, {3, 0.5 * (at.rear_knee + at.axle)}}};
  linkage.axle = {1, at.axle};
  linkage.start = LinkageVector(4);
  linkage.start << at.hip, at.knee, -0.7, linkage.hinges[3].reference;
  return linkage;
}

/// A four-bar: a rocker on the base ends on the shank above the knee. The rocker has the motor.
Linkage four_bar() {
  Linkage linkage;
  linkage.hinges = {
      {-1, {0.0, 0.0}, -1.0, 0.3}, {0, {0.1, -0.2}, -1.0, -0.8}, {-1, {0.12, -0.01}, 1.0, 0.2}};
  linkage.loops = {{{1, {0.2, -0.15}}, {2, {0.2, -0.15}}}};
  linkage.motors = {2};
  linkage.branch = {{0.2, {2, {0.16, -0.08}}}};
  linkage.axle = {1, {-0.05, -0.4}};
  linkage.start = LinkageVector(3);
  linkage.start << 0.3, -0.8, 0.2;
  return linkage;
}

LinkageVector moved_by_motors(const Linkage& linkage, const std::vector<double>& angle) {
  LinkageVector q = linkage.start;
  EXPECT_TRUE(move_linkage(linkage, linkage.motors, angle, q));
  return q;
}

TEST(Linkage, IsTheClosedFormOfAFiveBar) {
  const Linkage linkage = five_bar();
  for (const auto& [front, rear] : {std::pair(0.2, -0.3), {0.9, -0.8}, {1.2, -0.2}, {0.3, -1.3}}) {
    const FiveBar expected(front, rear);
    const LinkageVector q = moved_by_motors(linkage, {front, rear});
    EXPECT_NEAR(q[0], expected.hip, 1e-10);
    EXPECT_NEAR(q[1], expected.knee, 1e-9);
    EXPECT_LT((LinkagePose(linkage, q).place(linkage.axle) - expected.axle).norm(), 1e-9);
    EXPECT_LT((Matrix2d(MotorMap(linkage, q).leg) - expected.leg).norm(), 1e-7);
    LinkageVector back = linkage.start;
    EXPECT_TRUE(move_virtual_leg(linkage, expected.hip, expected.knee, back));
    EXPECT_LT((back - q).norm(), 1e-8);
  }
}

TEST(Linkage, HasTheRatesOfItsMotions) {
  constexpr double step = 1e-5;
  for (const Linkage& linkage : {five_bar(), four_bar()}) {
    std::vector<double> at;
    for (const int motor : linkage.motors) at.push_back(linkage.start[motor] + 0.1);
    const MotorMap map(linkage, moved_by_motors(linkage, at));
    for (std::size_t i = 0; i < at.size(); ++i) {
      std::vector<double> more = at, less = at;
      more[i] += step;
      less[i] -= step;
      const LinkageVector ahead = moved_by_motors(linkage, more);
      const LinkageVector behind = moved_by_motors(linkage, less);
      const auto motor = static_cast<Eigen::Index>(i);
      EXPECT_LT((map.all.col(motor) - (ahead - behind) / (2 * step)).norm(), 1e-6);
      // The weight of the branch: the derivative of its potential energy, per m/s² of gravity.
      double lifted = 0.0;
      for (const Linkage::Mass& body : linkage.branch) {
        lifted += body.mass * (LinkagePose(linkage, ahead).place(body.centre) -
                               LinkagePose(linkage, behind).place(body.centre))
                                  .y();
      }
      EXPECT_NEAR(map.branch(1, motor), lifted / (2 * step), 1e-6);
    }
  }
}

TEST(Linkage, KeepsThePowerOfItsMotors) {
  const Linkage five = five_bar();
  const MotorMap map(five, five.start);
  const Vector2d rates(0.7, -1.1);
  const Vector2d torques(3.0, -5.0);
  const LinkageVector at_motors = map.motor_torques(torques);
  EXPECT_NEAR(at_motors.dot(map.motor_rates(rates)), torques.dot(rates), 1e-9);
  EXPECT_LT((map.leg_torques(at_motors, {0.0, 0.0}) - torques).norm(), 1e-9);

  const Linkage four = four_bar();
  const MotorMap single(four, four.start);
  // A force straight up on the axle is all that one motor knows of.
  const Vector2d pressing = 60.0 * single.lift;
  const LinkageVector at_motor = single.motor_torques(pressing);
  ASSERT_EQ(at_motor.size(), 1);
  EXPECT_LT((single.leg_torques(at_motor, {0.0, 0.0}) - pressing).norm(), 1e-9);
}

TEST(Linkage, KnowsWhatItsMotorsDetermine) {
  const Linkage five = five_bar();
  EXPECT_EQ(mobility(five, five.start), 2);
  EXPECT_EQ(mobility(four_bar(), four_bar().start), 1);
  EXPECT_TRUE(is_regular(five, five.start));
  // Stretched to its reach, crank and rod of the virtual leg are in line with those behind.
  LinkageVector stretched = five.start;
  ASSERT_TRUE(move_linkage(five, five.motors, std::array{-0.1155, 0.1155}, stretched));
  EXPECT_FALSE(is_regular(five, stretched));
  Linkage weak = five;
  weak.motors = {0};
  EXPECT_FALSE(is_regular(weak, five.start));
}

TEST(Linkage, StaysWhereItsLoopsDoNotClose) {
  const Linkage five = five_bar();
  LinkageVector q = five.start;
  EXPECT_FALSE(move_virtual_leg(five, 0.0, 0.0, q));  // .43 m long: longer than it reaches
  EXPECT_EQ(q, five.start);
  EXPECT_FALSE(move_virtual_leg(five, std::nan(""), 0.0, q));
}

/// Closed legs of two five-bars; the second motor of each counts the other way, from another zero.
ClosedLegs legs_of(const Linkage& linkage) {
  MotorLeg leg{linkage};
  leg.sign = {1.0, -1.0};
  leg.zero = {0.0, 0.25};
  return ClosedLegs({leg, leg});
}

TEST(ClosedLegs, AreHipsAndKneesOfTheirMotors) {
  ClosedLegs legs = closed_legs_of(arrays_of(legs_of(five_bar())));
  for (int k = 0; k < 200; ++k) {
    const double front = 0.6 + 0.4 * std::sin(0.03 * k);
    const double rear = -0.7 - 0.3 * std::sin(0.05 * k);
    std::array<LegSignals, 2> signals;
    signals[0].hip = {front, 2.0, 4.0};
    signals[0].knee = {-(rear - 0.25), 3.0, 5.0};
    signals[1].wheel = {1.0, 2.0, 3.0};
    signals[1].hip.position = std::nan("");
    legs.convert(signals, {0.0, 0.0, 0.0});  // in free fall bodies have no weight
    const FiveBar expected(front, rear);
    EXPECT_NEAR(signals[0].hip.position, expected.hip, 1e-9);
    EXPECT_NEAR(signals[0].knee.position, expected.knee, 1e-8);
    const Vector2d rates = expected.leg * Vector2d(2.0, -3.0);
    EXPECT_NEAR(signals[0].knee.velocity, rates.y(), 1e-6);
    const Vector2d torques(signals[0].hip.torque, signals[0].knee.torque);
    EXPECT_LT((expected.leg.transpose() * torques - Vector2d(4.0, -5.0)).norm(), 1e-6);
    EXPECT_TRUE(std::isnan(signals[1].hip.position) && std::isnan(signals[1].knee.torque));
    EXPECT_EQ(signals[1].wheel.torque, 3.0);
  }
}

TEST(ClosedLegs, WithoutAnAccelerationLackTheirTorquesAlone) {
  ClosedLegs legs = legs_of(four_bar());
  std::array<LegSignals, 2> signals;
  for (LegSignals& leg : signals) leg.hip = {0.25, 0.1, 2.0};
  legs.convert(signals, Eigen::Vector3d::Constant(std::nan("")));
  EXPECT_TRUE(std::isfinite(signals[0].knee.position) && std::isfinite(signals[0].hip.velocity));
  EXPECT_TRUE(std::isnan(signals[0].hip.torque));
}

TEST(ClosedLegs, OfArraysThatAreNoLinkageAreRefused) {
  const ModelArrays good = arrays_of(legs_of(five_bar()));
  const auto refused = [&](const std::string& name, std::size_t number, double value) {
    ModelArrays bad = good;
    bad.at(name).data.at(number) = value;
    return complaint_of([&] { (void)closed_legs_of(bad); });
  };
  using ::testing::HasSubstr;
  EXPECT_THAT(refused("left_hinges", 5, 7.0), HasSubstr("left_hinges: expected the number of a"));
  EXPECT_THAT(refused("right_loops", 0, 0.5), HasSubstr("right_loops"));
  EXPECT_THAT(refused("left_motors", 0, -1.0), HasSubstr("left_motors"));
  EXPECT_THAT(refused("left_axle", 1, std::nan("")), HasSubstr("finite"));
  ModelArrays less = good;
  less.erase("left_start");
  EXPECT_THAT(complaint_of([&] { (void)closed_legs_of(less); }), HasSubstr("left_start"));
  ModelArrays open = good;
  open["left_loops"] = {{0, 6}, {}};
  EXPECT_THAT(complaint_of([&] { (void)closed_legs_of(open); }), HasSubstr("expected a leg with"));
}

}  // namespace
}  // namespace touchdown
