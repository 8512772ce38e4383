#include <cmath>

#include <gtest/gtest.h>

#include "policies/policy.hpp"

namespace touchdown::policies {
namespace {

using models::Servo;

/// A soft lander with contact set by the test, and its observation.
class SoftLanding : public ::testing::Test {
 protected:
  SoftLanding() {
    bend(0.455, -0.791);
    policy_->reset(seen_);
  }

  std::unique_ptr<Policy> lander(const std::string& robot,
                                 const WheelBalancerConfig& gains = {}) const {
    return make_soft_lander(
        {.gains = gains,
         .course = {},
         .contact =
             [this](const models::Observation&, const models::Action* /*previous*/) {
               return std::array<bool, 2>{in_contact_, in_contact_ && right_in_contact_too_};
             }},
        models::compile_robot_model(TOUCHDOWN_SOURCE_DIR "/models/" + robot, {}));
  }

  void bend(double hip, double knee) {
    for (const auto& [servo, angle] :
         {std::pair{Servo::left_hip, hip}, std::pair{Servo::left_knee, knee},
          std::pair{Servo::right_hip, -hip}, std::pair{Servo::right_knee, -knee}}) {
      seen_.servo[models::index(servo)].position = angle;
    }
  }
  models::Action step(bool in_contact) {
    in_contact_ = in_contact;
    seen_.time += 1e-3;
    return policy_->act(seen_);
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
  /// How far a knee in the posture of the reset is between stiff (0) and softest (1).
  static double softness(const models::Action& action) {
    constexpr double stiff = 2.0;  // the factor on its gain of a leg that has not flown
    return (stiff - action.servo[models::index(Servo::left_knee)].kp_scale) / (stiff - softest());
  }

  models::Observation seen_;
  bool in_contact_ = true;
  bool right_in_contact_too_ = true;
  std::unique_ptr<Policy> policy_ = lander("upkie.xml");

 private:
  /// 500 N/m along the line from hip to axle, by its lever arm at the knee, as the knee's gain.
  static double softest() {
    const double line =
        std::sqrt(0.168 * 0.168 + 0.175 * 0.175 + 2 * 0.168 * 0.175 * std::cos(0.791));
    const double lever = 0.168 * 0.175 * std::sin(0.791) / line;
    return 500.0 * lever * lever / models::servo_kp;
  }
};

/// In the air, the wheels' speed is 5.5 m/s per radian by which the centre of mass leans.
TEST_F(SoftLanding, BalancesTheCentreOfMassThatTheEngineHas) {
  for (const char* const file :
       {"upkie.xml", "upkie_long_legs.yaml", "hip_roll.yaml", "ros_style.yaml"}) {
    policy_ = lander(file, {.max_velocity = 100.0});
    const models::RobotModel robot =
        models::compile_robot_model(std::string(TOUCHDOWN_SOURCE_DIR "/models/") + file, {});
    const mjModel& mj = *robot.mj;
    const models::MjDataPtr data(mj_makeData(&mj));
    for (const auto& [hip, knee, pitch] :
         {std::array{0.0, 0.0, 0.0}, std::array{0.455, -0.791, 0.0}, std::array{0.3, -1.2, 0.4},
          std::array{-0.5, 0.2, -0.7}}) {
      const Eigen::Quaterniond leaning(Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()));
      models::write_pose(robot, Eigen::Vector3d::Zero(), leaning, {hip, knee, 0, -hip, -knee, 0},
                         data->qpos);
      mj_kinematics(&mj, data.get());
      Eigen::Vector3d moments = Eigen::Vector3d::Zero();
      double mass = 0.0;
      for (int body = robot.base_body; body < mj.nbody; ++body) {  // all but the wheels
        const auto is_part_of = [&](int tyre) {
          return mj.body_weldid[body] == mj.body_weldid[mj.geom_bodyid[tyre]];
        };
        if (is_part_of(robot.tyre_geom[0]) || is_part_of(robot.tyre_geom[1])) continue;
        mass += mj.body_mass[body];
        moments += mj.body_mass[body] * models::vector_at(data->xipos, body);
      }
      const Eigen::Vector3d axle = 0.5 * (models::vector_at(data->geom_xpos, robot.tyre_geom[0]) +
                                          models::vector_at(data->geom_xpos, robot.tyre_geom[1]));
      const Eigen::Vector3d centre = moments / mass - axle;
      bend(hip, knee);
      seen_.pitch = pitch;
      policy_->reset(seen_);
      EXPECT_NEAR(asked_speed(steps(100, false)) / 5.5, std::atan2(centre.x(), centre.z()), 1e-9)
          << file;
    }
  }
}

TEST_F(SoftLanding, KeepsTheGroundsSpeedInTheAir) {
  const double by_lean = asked_speed(steps(200, false));
  policy_->reset(seen_);
  roll_at(0.6);
  steps(300, true);
  roll_at(3.0);  // the wheels would run away
  const double before = asked_speed(steps(200, false));
  EXPECT_NEAR(before, 0.6 + by_lean, 1e-3);
  roll_at(0.6);
  EXPECT_NEAR(asked_speed(step(true)), before, 0.01) << "it lands without a bump";
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
  const auto calm = lander("upkie.xml");
  models::Observation still = seen_;
  still.pitch = still.yaw = 0.0;
  for (std::size_t wheel : {models::index(Servo::left_wheel), models::index(Servo::right_wheel)}) {
    still.servo[wheel].velocity = 0.0;
  }
  calm->reset(still);
  for (int k = 0; k < 200; ++k) {
    const models::Action action = step(k < 100 || k >= 155);
    in_contact_ = true;
    const models::Action expected = calm->act(seen_);
    for (std::size_t i = 0; i < models::servo_count; ++i) {
      EXPECT_EQ(action.servo[i].velocity, expected.servo[i].velocity) << k;
      EXPECT_EQ(action.servo[i].feedforward_torque, expected.servo[i].feedforward_torque) << k;
      EXPECT_EQ(action.servo[i].kp_scale, expected.servo[i].kp_scale) << k;
    }
  }
}

TEST_F(SoftLanding, SoftensInFlightAndStiffensAfterLanding) {
  struct Phase {
    int steps;
    bool in_contact;
    double softness, tolerance;
  };
  for (const Phase& phase :
       {Phase{50, true, 0.0, 0.0}, Phase{50, false, 0.0, 0.0},  // a false alarm
        Phase{60, false, 0.5, 1e-9}, Phase{60, false, 1.0, 1e-9}, Phase{250, true, 1.0, 0.01},
        Phase{200, true, 0.5, 0.01}, Phase{300, true, 0.0, 0.0}}) {
    EXPECT_NEAR(softness(steps(phase.steps, phase.in_contact)), phase.softness, phase.tolerance);
  }
}

TEST_F(SoftLanding, SinksOverOneWheelThatHangsButNotOverABump) {
  steps(50, true);
  right_in_contact_too_ = false;
  EXPECT_EQ(softness(steps(95, true)), 0.0);
  right_in_contact_too_ = true;
  steps(5, true);
  right_in_contact_too_ = false;
  EXPECT_NEAR(softness(steps(150, true)), 0.5, 1e-9);
  const models::Action sinking = steps(100, true);
  EXPECT_NEAR(softness(sinking), 1.0, 1e-9);
  // Half of the weight on each knee, without a ramp: the left one stood all along.
  const double left = sinking.servo[models::index(Servo::left_knee)].feedforward_torque;
  EXPECT_GT(std::abs(left), 0.5);
  EXPECT_EQ(left, -sinking.servo[models::index(Servo::right_knee)].feedforward_torque);
  // And it balances on.
  seen_.pitch = 0.1;
  const double leaning = asked_speed(step(true));
  seen_.pitch = 0.0;
  EXPECT_GT(leaning, asked_speed(step(true)));
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
  ASSERT_NEAR(softness(steps(500, false)), 1.0, 1e-9);
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
  const double torque = 0.5 * 5.33922 * 9.81 * slope;
  const double left = action.servo[models::index(Servo::left_knee)].feedforward_torque;
  EXPECT_NEAR(left, torque, 1e-5);
  EXPECT_GT(left, 0.0);  // straightens
  EXPECT_NEAR(action.servo[models::index(Servo::right_knee)].feedforward_torque, -left, 1e-9);
}

}  // namespace
}  // namespace touchdown::policies
