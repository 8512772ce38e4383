#include "policies/soft_lander.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "models/terrain.hpp"

namespace touchdown::policies {
namespace {

using models::Servo;

models::RobotModel upkie_model() {
  return models::compile_robot_model(TOUCHDOWN_SOURCE_DIR "/models/upkie.xml", {});
}

class SideViewOf : public ::testing::TestWithParam<const char*> {};

TEST_P(SideViewOf, ARobotHasItsCentreOfMassWhereTheEngineHasIt) {
  const models::RobotModel robot =
      models::compile_robot_model(std::string(TOUCHDOWN_SOURCE_DIR "/models/") + GetParam(), {});
  const SideView view = side_view(robot);
  const models::MjDataPtr data(mj_makeData(robot.mj.get()));
  for (const auto& [hip, knee, pitch] : {std::array{0.0, 0.0, 0.0}, std::array{0.455, -0.791, 0.0},
                                         std::array{0.3, -1.2, 0.4}, std::array{-0.5, 0.2, -0.7}}) {
    const Eigen::Quaterniond leaning(Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()));
    models::write_pose(robot, Eigen::Vector3d::Zero(), leaning, {hip, knee, 0, -hip, -knee, 0},
                       data->qpos);
    mj_kinematics(robot.mj.get(), data.get());
    const Eigen::Vector3d axle = 0.5 * (models::vector_at(data->geom_xpos, robot.tyre_geom[0]) +
                                        models::vector_at(data->geom_xpos, robot.tyre_geom[1]));
    Eigen::Vector3d moments = Eigen::Vector3d::Zero();
    double mass = 0.0;
    for (int body = robot.base_body; body < robot.mj->nbody; ++body) {
      const auto is_part_of = [&](int tyre) {
        return robot.mj->body_weldid[body] == robot.mj->body_weldid[robot.mj->geom_bodyid[tyre]];
      };
      if (is_part_of(robot.tyre_geom[0]) || is_part_of(robot.tyre_geom[1])) continue;
      mass += robot.mj->body_mass[body];
      moments += robot.mj->body_mass[body] * models::vector_at(data->xipos, body);
    }
    const Eigen::Vector3d centre = moments / mass - axle;
    const Eigen::Vector2d found = view.centre(hip, knee, pitch);
    EXPECT_NEAR(found.x(), centre.x(), 1e-9);
    EXPECT_NEAR(found.y(), centre.z(), 1e-9);
  }
  EXPECT_NEAR(view.mass, robot.mj->body_subtreemass[robot.base_body], 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Robots, SideViewOf,
                         ::testing::Values("upkie.xml", "upkie_long_legs.yaml", "hip_roll.yaml",
                                           "ros_style.yaml"));

/// A soft lander with contact set by the test, and its observation.
class SoftLanding : public ::testing::Test {
 protected:
  SoftLanding() {
    seen_.servo[models::index(Servo::left_hip)].position = 0.455;
    seen_.servo[models::index(Servo::left_knee)].position = -0.791;
    seen_.servo[models::index(Servo::right_hip)].position = -0.455;
    seen_.servo[models::index(Servo::right_knee)].position = 0.791;
    policy_.reset(seen_);
  }

  models::Action step(bool in_contact) {
    in_contact_ = in_contact;
    seen_.time += 1e-3;
    return policy_.act(seen_);
  }
  models::Action steps(int count, bool in_contact) {
    models::Action action;
    for (int k = 0; k < count; ++k) action = step(in_contact);
    return action;
  }
  void roll_at(double speed) {  // m/s
    seen_.servo[models::index(Servo::left_wheel)].velocity = speed / 0.05;
    seen_.servo[models::index(Servo::right_wheel)].velocity = -speed / 0.05;
  }
  static double asked_speed(const models::Action& action) {
    return 0.05 * action.servo[models::index(Servo::left_wheel)].velocity;
  }

  models::Observation seen_;
  bool in_contact_ = true;
  bool right_in_contact_too_ = true;
  SoftLander policy_{
      WheelBalancerConfig{}, make_course({}, 0.05, 1e-3), side_view(upkie_model()),
      [this](const models::Observation&, const models::Action* /*previous*/) {
        return std::array<bool, 2>{in_contact_, in_contact_ && right_in_contact_too_};
      }};
};

TEST_F(SoftLanding, KeepsTheGroundsSpeedInTheAir) {
  roll_at(0.6);
  steps(300, true);
  roll_at(3.0);  // the wheels would run away
  const double lean = std::atan2(side_view(upkie_model()).centre(0.455, -0.791, 0.0).x(),
                                 side_view(upkie_model()).centre(0.455, -0.791, 0.0).y());
  EXPECT_NEAR(asked_speed(steps(200, false)), 0.6 + 5.5 * lean, 1e-3);
}

TEST_F(SoftLanding, LandsWithoutABump) {
  roll_at(0.6);
  steps(300, true);
  const double before = asked_speed(steps(200, false));
  EXPECT_NEAR(asked_speed(step(true)), before, 0.01);
}

TEST_F(SoftLanding, TurnsNothingInTheAir) {
  seen_.yaw = 0.3;
  const auto torque = [](const models::Action& action) {
    return action.servo[models::index(Servo::left_wheel)].feedforward_torque;
  };
  EXPECT_GT(torque(step(true)), 0.1);
  EXPECT_EQ(torque(steps(70, false)), 0.0);
}

TEST_F(SoftLanding, BalancesOnThroughAFalseAlarmAsIfThereWereNone) {
  roll_at(0.6);
  seen_.yaw = 0.3;
  seen_.pitch = 0.05;
  SoftLander calm(WheelBalancerConfig{}, make_course({}, 0.05, 1e-3), side_view(upkie_model()),
                  [](const models::Observation&, const models::Action* /*previous*/) {
                    return std::array{true, true};
                  });
  models::Observation still = seen_;
  still.pitch = still.yaw = 0.0;
  for (std::size_t wheel : {models::index(Servo::left_wheel), models::index(Servo::right_wheel)}) {
    still.servo[wheel].velocity = 0.0;
  }
  calm.reset(still);
  for (int k = 0; k < 200; ++k) {
    const models::Action action = step(k < 100 || k >= 155);
    const models::Action expected = calm.act(seen_);
    for (std::size_t i = 0; i < models::servo_count; ++i) {
      EXPECT_EQ(action.servo[i].velocity, expected.servo[i].velocity) << k;
      EXPECT_EQ(action.servo[i].feedforward_torque, expected.servo[i].feedforward_torque) << k;
      EXPECT_EQ(action.servo[i].kp_scale, expected.servo[i].kp_scale) << k;
    }
  }
}

TEST_F(SoftLanding, SoftensInFlightAndStiffensAfterLanding) {
  steps(50, true);
  EXPECT_EQ(policy_.softness(), 0.0);
  steps(50, false);  // a false alarm
  EXPECT_EQ(policy_.softness(), 0.0);
  steps(60, false);
  EXPECT_NEAR(policy_.softness(), 0.5, 1e-9);
  steps(60, false);
  EXPECT_NEAR(policy_.softness(), 1.0, 1e-9);
  steps(250, true);
  EXPECT_NEAR(policy_.softness(), 1.0, 0.01);
  steps(200, true);
  EXPECT_NEAR(policy_.softness(), 0.5, 0.01);
  steps(300, true);
  EXPECT_EQ(policy_.softness(), 0.0);
}

TEST_F(SoftLanding, SinksOverOneWheelThatHangsButNotOverABump) {
  steps(50, true);
  right_in_contact_too_ = false;
  steps(95, true);
  EXPECT_EQ(policy_.softness(), 0.0);
  right_in_contact_too_ = true;
  steps(5, true);
  right_in_contact_too_ = false;
  steps(150, true);
  EXPECT_NEAR(policy_.softness(), 0.5, 1e-9);
  const models::Action sinking = steps(100, true);
  EXPECT_NEAR(policy_.softness(), 1.0, 1e-9);
  // Half of the weight on each knee, without a ramp: the left one stood all along.
  const double left = sinking.servo[models::index(Servo::left_knee)].feedforward_torque;
  const double right = sinking.servo[models::index(Servo::right_knee)].feedforward_torque;
  EXPECT_GT(std::abs(left), 0.5);
  EXPECT_EQ(left, -right);
  // And it balances on.
  seen_.pitch = 0.1;
  const double leaning = asked_speed(steps(1, true));
  seen_.pitch = 0.0;
  EXPECT_GT(leaning, asked_speed(steps(1, true)));
}

TEST_F(SoftLanding, IsTheStiffBalancerBeforeAnyFlight) {
  const models::Action action = steps(10, true);
  for (const Servo servo : {Servo::left_hip, Servo::left_knee, Servo::right_knee}) {
    const models::ServoCommand& command = action.servo[models::index(servo)];
    EXPECT_NEAR(command.position, seen_.servo[models::index(servo)].position, 1e-12);
    EXPECT_EQ(command.kp_scale, 2.0);
    EXPECT_EQ(command.kd_scale, 2.0);
    EXPECT_EQ(command.feedforward_torque, 0.0);
    EXPECT_EQ(command.velocity, 0.0);
  }
}

TEST_F(SoftLanding, FoldsItsLegAlongItsLine) {
  // A soft knee that has yielded: the hip goes where the axle stays on the line through the hip
  // that it was on. The oracle: where the axle is, by the links.
  const auto direction = [](double hip, double knee) {
    return std::atan2(0.168 * std::sin(hip) + 0.175 * std::sin(hip + knee),
                      0.168 * std::cos(hip) + 0.175 * std::cos(hip + knee));
  };
  steps(500, false);
  ASSERT_EQ(policy_.softness(), 1.0);
  for (const double knee : {-0.9, -1.2, -1.6}) {
    seen_.servo[models::index(Servo::left_knee)].position = knee;
    seen_.servo[models::index(Servo::right_knee)].position = -knee;
    const models::Action action = step(true);
    const double left = action.servo[models::index(Servo::left_hip)].position;
    EXPECT_NEAR(direction(left, knee), direction(0.455, -0.791), 1e-9);
    EXPECT_NEAR(action.servo[models::index(Servo::right_hip)].position, -left, 1e-12);
  }
}

TEST_F(SoftLanding, CarriesTheWeightOnSoftKnees) {
  steps(500, false);
  const models::Action action = steps(100, true);  // soft still, its ramp over
  // Half the weight along the leg's line, by the derivative of its length to the knee.
  const auto length = [](double knee) {
    return std::sqrt(0.168 * 0.168 + 0.175 * 0.175 + 2 * 0.168 * 0.175 * std::cos(knee));
  };
  const double slope = (length(-0.791 + 1e-6) - length(-0.791 - 1e-6)) / 2e-6;
  const double torque = 0.5 * side_view(upkie_model()).mass * 9.81 * slope;
  const double left = action.servo[models::index(Servo::left_knee)].feedforward_torque;
  EXPECT_NEAR(left, torque, 1e-6);
  EXPECT_GT(left, 0.0);  // straightens
  EXPECT_NEAR(action.servo[models::index(Servo::right_knee)].feedforward_torque, -left, 1e-9);
}

}  // namespace
}  // namespace touchdown::policies
