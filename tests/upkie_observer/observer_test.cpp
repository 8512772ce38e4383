#include <cmath>
#include <stdexcept>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "examples/upkie_observer/TouchdownObserver.h"
#include "examples/upkie_observer/compiled_model.h"
#include "logs/model_file.hpp"
#include "tests/estimator/models/models.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown {
namespace {

using ::testing::HasSubstr;
using upkie::cpp::observers::Dictionary;
using upkie::cpp::observers::Observer;
using upkie::cpp::observers::TouchdownObserver;

/// Fills the observation that a spine passes to its observers.
void observe(const Signals& s, Dictionary& observation) {
  observation("time") = s.time;
  for (std::size_t side = 0; side < 2; ++side) {
    const std::string prefix = side == 0 ? "left_" : "right_";
    const auto servo = [&](const char* name, const JointSignals& joint) {
      Dictionary& output = observation("servo")(prefix + name);
      output("position") = joint.position;
      output("velocity") = joint.velocity;
      output("torque") = joint.torque;
    };
    JointSignals hip = s.leg[side].hip;
    hip.position += 1e-6 * s.time;  // no servo repeats itself to the bit
    servo("hip", hip);
    servo("knee", s.leg[side].knee);
    servo("wheel", s.leg[side].wheel);
  }
  Dictionary& imu = observation("imu");
  imu("orientation") = Eigen::Quaterniond(0.0, 0.0, 0.0, 1.0);
  imu("angular_velocity") = Eigen::Vector3d(0.0, 0.0, 0.0);
  imu("linear_acceleration") = Eigen::Vector3d(0.0, 0.0, -s.vertical_acceleration);
  imu("raw_linear_acceleration") = Eigen::Vector3d(0.0, 0.0, -s.vertical_acceleration - 9.81);
}

class UpkiesObserver : public ::testing::Test {
 protected:
  UpkiesObserver() {
    logs::write_npz(test::fitted_model("robust"), folder_ / "m.npz");
    params_.model = (folder_ / "m.npz").string();
  }

  std::string complaint() const {
    try {
      TouchdownObserver observer(params_);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "nothing was thrown";
  }

  const ScratchFolder folder_;
  TouchdownObserver::Parameters params_;
  Dictionary config_;
};

TEST_F(UpkiesObserver, WritesTheBeliefsOfTheLibrary) {
  const std::shared_ptr<Observer> observer = std::make_shared<TouchdownObserver>(params_);
  const auto expected = make_estimator(test::fitted_model("robust"));
  EXPECT_EQ(observer->prefix(), "floor_contact");
  Dictionary observation;
  // The output of Upkie's FloorContact.
  observation("floor_contact")("contact") = true;
  observation("floor_contact")("upper_leg_torque") = 3.25;
  observation("floor_contact")("left_wheel")("inertia") = 0.002;
  for (int again = 0; again < 2; ++again) {
    observer->reset(config_);
    expected->reset();
    for (const Signals& s : test::drops(1500)) {
      observe(s, observation);
      observer->read(observation);
      observer->write(observation);
      const Belief& belief = expected->update(s);
      const Dictionary& output = observation("floor_contact");
      const bool any = belief.wheel[0].contact || belief.wheel[1].contact;
      ASSERT_EQ(output.get<bool>("contact"), any);
      ASSERT_EQ(output("left_wheel").get<bool>("contact"), belief.wheel[0].contact);
      ASSERT_EQ(output("left_wheel").get<double>("p_contact"), belief.wheel[0].p_contact);
      ASSERT_EQ(output("right_wheel").get<double>("p_contact"), belief.wheel[1].p_contact);
      ASSERT_EQ(output.get<double>("p_any_wheel"), belief.p_any_wheel);
      ASSERT_EQ(output.get<double>("p_both_wheels"), belief.p_both_wheels);
      ASSERT_EQ(output.get<std::string>("status"), "good");
      ASSERT_EQ(output.get<unsigned>("faults"), 0U);
    }
  }
  EXPECT_EQ(observation("floor_contact").get<double>("upper_leg_torque"), 3.25);
  EXPECT_EQ(observation("floor_contact")("left_wheel").get<double>("inertia"), 0.002);
}

TEST_F(UpkiesObserver, LeavesTheDecisionToFloorContactIfConfigured) {
  config_("touchdown")("decides") = false;
  TouchdownObserver observer(params_);
  observer.reset(config_);
  Dictionary observation;
  observation("floor_contact")("contact") = false;
  for (const Signals& s : test::drops(300)) {
    observe(s, observation);
    observer.read(observation);
    observer.write(observation);
  }
  EXPECT_FALSE(observation("floor_contact").get<bool>("contact"));
  EXPECT_GT(observation("floor_contact").get<double>("p_any_wheel"), 0.9);
}

TEST_F(UpkiesObserver, AcceptsIncompleteObservations) {
  TouchdownObserver observer(params_);
  Dictionary observation;
  observer.read(observation);
  observer.write(observation);
  EXPECT_EQ(observation("floor_contact").get<std::string>("status"), "invalid");
  // A torque is missing now and then, and some simulators report no time.
  double least = 1.0;
  for (const Signals& s : test::drops(700)) {
    Dictionary record;
    observe(s, record);
    Dictionary timeless;
    timeless("servo")("left_knee")("torque") = std::string("none");
    observer.read(s.time > 0.3 && s.time < 0.302 ? timeless : record);
    observer.write(record);
    if (s.time > 0.2) least = std::min(least, record("floor_contact").get<double>("p_any_wheel"));
  }
  EXPECT_GT(least, 0.8);
}

TEST_F(UpkiesObserver, NamesItsModel) {
  EXPECT_THAT(TouchdownObserver(params_).model(), HasSubstr("robust, 1000 Hz, robot upkie, "));
}

TEST_F(UpkiesObserver, RefusesAModelOfAnotherFrequencyOrRobotBeforeTheRobotMoves) {
  params_.dt = 0.005;
  EXPECT_THAT(complaint(), HasSubstr("m.npz: was fitted at 1000 Hz, not at 200 Hz"));
  params_.dt = 0.001;
  params_.robot = "tall";
  EXPECT_THAT(complaint(), HasSubstr("was fitted to the robot 'upkie', not to 'tall'"));
  params_.model = "none.npz";
  EXPECT_THAT(complaint(), HasSubstr("[TouchdownObserver] none.npz: no such file"));
  params_.model.clear();
  TouchdownObserver observer(params_);
  EXPECT_THROW(observer.reset(config_), std::runtime_error);
}

TEST_F(UpkiesObserver, LoadsAModelFromTheConfigurationOrCompiledIn) {
  config_("touchdown")("model") = params_.model;
  params_.model.clear();
  TouchdownObserver observer(params_);
  observer.reset(config_);
  EXPECT_THAT(observer.model(), HasSubstr("robust"));
  const touchdown_use use = {nullptr, 1000.0, "upkie"};
  TouchdownObserver compiled(params_,
                             TouchdownObserver::Estimator(compiled_model(&use, nullptr, 0)));
  compiled.reset(Dictionary());
  EXPECT_THAT(compiled.model(), HasSubstr("load_filter, 1000 Hz, robot upkie"));
  char error[200];  // NOLINT: C's
  const touchdown_use other = {nullptr, 0.0, "tall"};
  EXPECT_EQ(compiled_model(&other, error, sizeof error), nullptr);
  EXPECT_STREQ(error, "was fitted to the robot 'upkie', not to 'tall'");
}

}  // namespace
}  // namespace touchdown
