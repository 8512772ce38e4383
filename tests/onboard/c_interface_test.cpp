#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "estimator/force/closed_legs.hpp"
#include "estimator/signal_assembler.hpp"
#include "estimator/touchdown.h"
#include "logs/model_file.hpp"
#include "tests/estimator/models/models.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class CInterface : public ::testing::Test {
 protected:
  CInterface() { logs::write_npz(test::fitted_model("robust"), folder_ / "m.npz"); }

  std::string model() const { return (folder_ / "m.npz").string(); }

  const ScratchFolder folder_;
};

ClosedLegs legs_without_loops(const ClosedLegs& legs) {
  std::array<MotorLeg, 2> open = legs.legs();
  for (MotorLeg& leg : open) leg.linkage.loops.clear();
  return ClosedLegs(open);
}

touchdown_record record_of(const Signals& s) {
  touchdown_record record = touchdown_empty_record();
  record.time = s.time;
  for (std::size_t side = 0; side < 2; ++side) {
    const LegSignals& leg = s.leg[side];
    record.joint[3 * side] = {leg.hip.position, leg.hip.velocity, leg.hip.torque};
    record.joint[3 * side + 1] = {leg.knee.position, leg.knee.velocity, leg.knee.torque};
    record.joint[3 * side + 2] = {leg.wheel.position, leg.wheel.velocity, leg.wheel.torque};
  }
  record.orientation[0] = record.orientation[1] = record.orientation[2] = 0.0;
  record.orientation[3] = 1.0;
  record.linear_acceleration[0] = record.linear_acceleration[1] = 0.0;
  record.linear_acceleration[2] = -s.vertical_acceleration;
  return record;
}

/// A run on bent legs, of which no servo repeats itself.
std::vector<Signals> moving(std::size_t steps) {
  std::vector<Signals> all = test::drops_on_bent_legs(steps);
  for (Signals& s : all) {
    s.linear_acceleration.z() = -s.vertical_acceleration;
    for (LegSignals& leg : s.leg) {
      leg.hip.position += 1e-3 * std::sin(9.0 * s.time);
      leg.knee.position += 1e-3 * std::sin(9.0 * s.time);
      leg.hip.torque += 1e-3 * s.time;
    }
  }
  return all;
}

TEST_F(CInterface, ReportsErrorsInAnyRoom) {
  std::array<char, 200> error{};
  std::array<char, 6> shorter{};
  EXPECT_EQ(touchdown_create("none.npz", nullptr, shorter.data(), shorter.size()), nullptr);
  EXPECT_STREQ(shorter.data(), "none.");
  EXPECT_EQ(touchdown_create("none.npz", nullptr, nullptr, 0), nullptr);
  const touchdown_use other = {nullptr, 1000.0, "another_robot"};
  EXPECT_EQ(touchdown_create(nullptr, &other, error.data(), error.size()), nullptr);
  EXPECT_STREQ(error.data(), "was fitted to the robot 'upkie', not to 'another_robot'");
  touchdown_destroy(nullptr);
}

TEST_F(CInterface, IsTheFilterOfLoadsOfUpkieWithoutAFile) {
  touchdown_estimator* const estimator = touchdown_create(nullptr, nullptr, nullptr, 0);
  ASSERT_NE(estimator, nullptr);
  EXPECT_THAT(touchdown_model_text(estimator),
              StartsWith("load_filter, 1000 Hz, robot upkie, fingerprint "));
  touchdown_destroy(estimator);
}

TEST_F(CInterface, ReportsFaultsOfARecord) {
  touchdown_estimator* const estimator = touchdown_create(model().c_str(), nullptr, nullptr, 0);
  ASSERT_NE(estimator, nullptr);
  const touchdown_record nothing = touchdown_empty_record();
  const touchdown_belief belief = touchdown_update(estimator, &nothing);
  EXPECT_EQ(belief.status, TOUCHDOWN_INVALID);
  EXPECT_STREQ(touchdown_status_text(belief.status), "invalid");
  for (const unsigned fault : {TOUCHDOWN_JOINT_MISSING, TOUCHDOWN_ORIENTATION_MISSING,
                               TOUCHDOWN_ACCELERATION_MISSING, TOUCHDOWN_CLOCK_MISSING}) {
    EXPECT_NE(belief.faults & fault, 0U) << fault;
  }
  EXPECT_EQ(belief.faults & TOUCHDOWN_UPSIDE_DOWN, 0U);
  touchdown_destroy(estimator);
}

TEST_F(CInterface, TakesNullWithoutACrash) {
  touchdown_estimator* const estimator = touchdown_create(model().c_str(), nullptr, nullptr, 0);
  ASSERT_NE(estimator, nullptr);
  const touchdown_record record = touchdown_empty_record();
  for (const touchdown_belief& belief :
       {touchdown_update(nullptr, &record), touchdown_update(estimator, nullptr),
        touchdown_update(nullptr, nullptr)}) {
    EXPECT_EQ(belief.status, TOUCHDOWN_INVALID);
    EXPECT_EQ(belief.p_contact[0], 0.5);
    EXPECT_EQ(belief.unusable, -1);
  }
  touchdown_reset(nullptr);
  EXPECT_STREQ(touchdown_model_text(nullptr), "");
  for (const int number : {-1, -7, 5, 26, 1 << 30}) {
    EXPECT_STREQ(touchdown_signal_text(number == 5 ? -1 : number), "") << number;
    EXPECT_STREQ(touchdown_status_text(number), "") << number;
  }
  touchdown_destroy(estimator);
}

TEST(CVersion, IsTheProjects) { EXPECT_STREQ(touchdown_version(), PROJECT_VERSION); }

TEST_F(CInterface, NamesASignalBeyondItsBound) {
  touchdown_estimator* const estimator = touchdown_create(model().c_str(), nullptr, nullptr, 0);
  ASSERT_NE(estimator, nullptr);
  std::size_t k = 0;
  for (const Signals& s : test::drops(1200)) {
    touchdown_record record = record_of(s);
    if (k == 100) record.joint[4].torque = 1e308;    // right knee
    if (k == 101) record.joint[0].velocity = -1e39;  // left hip
    if (k == 102) record.angular_velocity[2] = 1e4;
    const touchdown_belief belief = touchdown_update(estimator, &record);
    const std::string expected = k == 100   ? "right knee torque"
                                 : k == 101 ? "left hip velocity"
                                 : k == 102 ? "angular velocity x"  // NaN: never reported
                                            : touchdown_signal_text(belief.unusable);
    EXPECT_EQ(touchdown_signal_text(belief.unusable), expected) << k;
    if (k == 100) {
      EXPECT_EQ(belief.status, TOUCHDOWN_INVALID);
    }
    EXPECT_TRUE(belief.p_contact[1] >= 0.0 && belief.p_contact[1] <= 1.0);
    ++k;
  }
  touchdown_destroy(estimator);
}

TEST_F(CInterface, RefusesConventionsThatAreNoneAndKeepsTheOnesBefore) {
  touchdown_estimator* const estimator = touchdown_create(model().c_str(), nullptr, nullptr, 0);
  ASSERT_NE(estimator, nullptr);
  touchdown_conventions wrong = touchdown_upkie_conventions();
  wrong.torque_unit = 0.0;
  EXPECT_EQ(touchdown_set_conventions(estimator, &wrong, nullptr, 0), 0);
  const touchdown_conventions upkie = touchdown_upkie_conventions();
  EXPECT_EQ(touchdown_set_conventions(nullptr, &upkie, nullptr, 0), 0);
  EXPECT_EQ(touchdown_set_conventions(estimator, nullptr, nullptr, 0), 0);
  touchdown_record record = record_of(test::drops(1).front());
  EXPECT_EQ(touchdown_update(estimator, &record).faults, 0U);
  ASSERT_EQ(touchdown_set_conventions(estimator, &upkie, nullptr, 0), 1);  // as before
  EXPECT_EQ(touchdown_update(estimator, &record).faults, 0U);
  touchdown_destroy(estimator);
}

TEST_F(CInterface, IsDegradedWithoutTheTargetsOfServos) {
  touchdown_estimator* const estimator = touchdown_create(nullptr, nullptr, nullptr, 0);
  ASSERT_NE(estimator, nullptr);
  touchdown_record record{};
  std::array<touchdown_target, 6> targets{};
  targets.fill({0.0, 0.0, 0.1, 40.0, 2.0});
  int seen = 0;
  for (const Signals& s : moving(300)) {
    record = record_of(s);
    record.angular_velocity[0] = record.angular_velocity[1] = record.angular_velocity[2] = 1e-5;
    const int status = touchdown_update_with_targets(estimator, &record, targets.data()).status;
    seen += status == TOUCHDOWN_GOOD ? 1 : 0;
  }
  EXPECT_GT(seen, 200);
  record.time += 0.001;
  EXPECT_EQ(touchdown_update(estimator, &record).status, TOUCHDOWN_DEGRADED);
  EXPECT_STREQ(touchdown_status_text(TOUCHDOWN_DEGRADED), "degraded");
  EXPECT_EQ(touchdown_update_with_targets(nullptr, &record, targets.data()).status,
            TOUCHDOWN_INVALID);
  EXPECT_TRUE(std::isnan(touchdown_update(nullptr, nullptr).load[0]));
  touchdown_destroy(estimator);
}

TEST_F(CInterface, TakesTheMotorsOfClosedLegs) {
  // A parallelogram: the second motor's crank turns the shank.
  Linkage linkage;
  linkage.hinges = {{-1, {0.0, 0.0}, -1.0, 0.4},
                    {0, {0.08, -0.15}, -1.0, -0.8},
                    {-1, {0.0, 0.0}, -1.0, 0.0},
                    {2, {0.04, 0.01}, -1.0, 0.0}};
  linkage.loops = {{{1, {0.12, -0.14}}, {3, {0.12, -0.14}}}};
  linkage.motors = {0, 2};
  linkage.axle = {1, {0.0, -0.3}};
  linkage.start = LinkageVector(4);
  linkage.start << 0.4, -0.8, 0.0, 0.0;
  const ClosedLegs legs({MotorLeg{linkage}, MotorLeg{linkage}});
  logs::write_npz(arrays_of(legs), folder_ / "legs.npz");
  logs::write_npz(arrays_of(legs_without_loops(legs)), folder_ / "open.npz");
  std::array<char, 200> error{};
  touchdown_estimator* const estimator =
      touchdown_create(model().c_str(), nullptr, error.data(), error.size());
  ASSERT_NE(estimator, nullptr) << error.data();
  EXPECT_EQ(touchdown_load_closed_legs(estimator, (folder_ / "open.npz").c_str(), error.data(),
                                       error.size()),
            0);
  EXPECT_THAT(error.data(), HasSubstr("open.npz: left_hinges"));
  EXPECT_EQ(touchdown_load_closed_legs(nullptr, nullptr, nullptr, 0), 0);
  ASSERT_EQ(touchdown_load_closed_legs(estimator, (folder_ / "legs.npz").c_str(), error.data(),
                                       error.size()),
            1)
      << error.data();
  SignalAssembler assembler({.sample_rate = 1000.0, .closed_legs = legs});
  const auto expected = make_estimator(test::fitted_model("robust"));
  for (Signals s : test::drops(1500)) {
    // The knee follows the second motor's angle less the first one's.
    for (LegSignals& leg : s.leg) leg.knee.position = 0.1 * leg.knee.position;
    touchdown_record record = record_of(s);
    std::array<JointSignals, 6> joints;
    for (std::size_t i = 0; i < 6; ++i) {
      joints[i] = {record.joint[i].position, record.joint[i].velocity, record.joint[i].torque};
    }
    const Signals& signals =
        assembler.assemble({.time = s.time,
                            .joints = joints,
                            .orientation = {0.0, 0.0, 0.0, 1.0},
                            .angular_velocity = Eigen::Vector3d::Constant(not_reported),
                            .linear_acceleration = {0.0, 0.0, -s.vertical_acceleration}});
    EXPECT_NEAR(signals.leg[0].knee.position,
                -0.8 + joints[1].position - (joints[0].position - 0.4), 1e-8);
    const Belief& belief = expected->update(signals);
    const touchdown_belief found = touchdown_update(estimator, &record);
    ASSERT_EQ(found.p_contact[0], belief.wheel[0].p_contact);
  }
  touchdown_destroy(estimator);
}

}  // namespace
}  // namespace touchdown
