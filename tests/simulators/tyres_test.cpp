#include <algorithm>
#include <cmath>

#include "tests/simulators/bodies.hpp"
#include "tests/simulators/upkie.hpp"

namespace touchdown::simulators {
namespace {

using models::Servo;
using models::Terrain;
using models::Tyre;

constexpr double half_track = 0.1524;  ///< from Upkie's middle plane to that of a tyre (m)

/// The robot of a shipped file, modified by `change`.
std::shared_ptr<models::RobotModel> robot_called(
    const std::string& file, const Terrain& terrain = {},
    const std::function<void(models::RobotModel&)>& change = {}) {
  auto model = std::make_shared<models::RobotModel>(
      models::compile_robot_model(TOUCHDOWN_SOURCE_DIR "/models/" + file, terrain));
  if (change) change(*model);
  return model;
}

/// Upkie on rubber with its torso's mass in the middle: with straight legs it acts as one mass.
std::shared_ptr<models::RobotModel> one_mass() {
  return robot_called("upkie_rubber.yaml", {}, [](models::RobotModel& robot) {
    robot.mj->body_ipos[3 * robot.base_body] = 0.0;
    const models::MjDataPtr data(mj_makeData(robot.mj.get()));
    mj_setConst(robot.mj.get(), data.get());
  });
}

/// Measurements of a drop.
struct Landing {
  double rebound = 0.0;  ///< height of the rebound (m)
  double peak = 0.0;     ///< largest upward acceleration, averaged over 1 ms (m/s²)
};

/// A mass that falls on a spring and damper, by Newton's law in steps of 1 µs.
Landing textbook_landing(double mass, const Tyre& tyre, double drop) {
  constexpr double step = 1e-6;
  Landing landing;
  double height = drop;
  double velocity = 0.0;
  std::array<double, 1000> last = {};  // velocities of the last millisecond
  for (std::size_t i = 0; landing.peak <= 0.0 || height < 0.0; i = (i + 1) % last.size()) {
    const double force =
        height < 0.0 ? std::max(0.0, -tyre.stiffness * height - tyre.damping * velocity) : 0.0;
    const double acceleration = force / mass - g;
    velocity += step * acceleration;
    height += step * velocity;
    landing.peak = std::max(landing.peak, (velocity - last.at(i)) / (step * 1e3));
    last.at(i) = velocity;
  }
  landing.rebound = 0.5 * velocity * velocity / g;
  return landing;
}

/// The same for a robot that falls on both tyres, with its joints held by `action`.
Landing landing_of(Simulator& simulator, const RobotState& start, double drop,
                   const models::Action& action) {
  RobotState raised = start;
  raised.position.z() += drop;
  simulator.reset(raised);
  Landing landing;
  bool landed = false;
  for (int i = 0; i < 700; ++i) {
    simulator.step(action, guide(simulator.state()));
    landed = landed || simulator.ground_truth().wheel_normal_force[0] > 0.0;
    const double up = simulator.state().linear_velocity.z();
    if (landed && landing.rebound > 0.0 && up < 0.0) break;
    if (landed && up > 0.0) {
      landing.rebound = simulator.state().position.z() - start.position.z();
    }
    landing.peak =
        std::max(landing.peak, models::vertical_acceleration(simulator.observation().imu));
  }
  return landing;
}

class TyreOfRubber : public EveryEngine {};

TEST_P(TyreOfRubber, SagsUnderTheWeightByItsStiffness) {
  const auto simulator = make(one_mass());
  simulator->reset(upright());
  stand(*simulator, 1.5);
  const double weight = g * motion(simulator->model(), simulator->state()).mass;
  const double sag = 0.5 * weight / simulator->model().tyre.stiffness;
  EXPECT_NEAR(upright().position.z() - simulator->state().position.z(), sag, 0.01 * sag);
  const auto& force = simulator->ground_truth().wheel_normal_force;
  EXPECT_NEAR(force[0] + force[1], weight, 1e-5 * weight) << "the force that labels use";
  EXPECT_FALSE(simulator->ground_truth().body_touches_terrain);
}

TEST_P(TyreOfRubber, LandsAndReboundsLikeAMassOnSpringAndDamper) {
  SimulatorOptions fine;
  fine.steps.physics_us = 100;
  const double mass = motion(*one_mass(), upright()).mass;
  for (const auto& [stiffness, damping] :
       {std::pair(8e3, 40.0), std::pair(2e4, 80.0), std::pair(1e5, 400.0)}) {
    const std::shared_ptr<models::RobotModel> robot = one_mass();
    robot->tyre.stiffness = stiffness;
    robot->tyre.damping = damping;
    const auto precise = make(robot, fine);
    const auto usual = make(robot);
    for (const double drop : {0.02, 0.05, 0.25}) {
      const Landing expected = textbook_landing(0.5 * mass, robot->tyre, drop);
      const Landing landing = landing_of(*precise, upright(), drop, locked(upright()));
      EXPECT_NEAR(landing.rebound, expected.rebound, 1e-4 + 0.02 * expected.rebound)
          << stiffness << ' ' << drop;
      EXPECT_NEAR(landing.peak, expected.peak, 0.02 * expected.peak) << stiffness << ' ' << drop;
      const Landing in_usual_steps = landing_of(*usual, upright(), drop, locked(upright()));
      EXPECT_NEAR(in_usual_steps.peak, expected.peak, 0.06 * expected.peak) << stiffness << drop;
    }
  }
  const auto simulator = make(one_mass());
  EXPECT_NEAR(textbook_landing(0.5 * mass, simulator->model().tyre, 0.25).rebound, 0.25 / 3, 0.002)
      << "a third of the height of a stair";
  EXPECT_NEAR(0.5 * mass * g / simulator->model().tyre.stiffness, 1.3e-3, 0.02e-3) << "sag (m)";
}

TEST_P(TyreOfRubber, ShortensPhysicsStepsForItsStiffness) {
  const auto step = [&](const std::string& file, double stiffness, StepSizes steps = {},
                        double damping = 80.0) {
    SimulatorOptions options;
    options.steps = steps;
    const auto simulator = make(robot_called(file, {},
                                             [&](auto& robot) {
                                               robot.tyre.stiffness = stiffness;
                                               robot.tyre.damping = damping;
                                             }),
                                options);
    EXPECT_EQ(simulator->options().steps.control_us, steps.control_us);
    return simulator->options().steps.physics_us;
  };
  EXPECT_EQ(step("upkie.xml", 2e4), 1000) << "the engine's own contact";
  EXPECT_EQ(step("upkie_rubber.yaml", 2e4), 1000);
  EXPECT_EQ(step("upkie_rubber.yaml", 1e5), 500);
  EXPECT_EQ(step("upkie_rubber.yaml", 4e5, {}, 200.0), 250);
  EXPECT_EQ(step("upkie_rubber.yaml", 2e2, {}, 1e3), 1000) << "no damper shortens it";
  EXPECT_EQ(step("upkie_rubber.yaml", 2e4, {}, 5.1), 250) << "but a weak one does";
  EXPECT_EQ(step("upkie_rubber.yaml", 2e4, {100, 1000}), 100) << "no longer than configured";
  EXPECT_EQ(step("upkie_rubber.yaml", 1e5, {5000, 5000}), 500);
}

/// Upkie with straight legs that rolls along x at 0.5 m/s. Forces at two heights push it and
/// prevent yaw; it is free to lean and to drift.
class Roller {
 public:
  Roller(std::unique_ptr<Simulator> simulator, double y, double ground)
      : simulator_(std::move(simulator)) {
    RobotState start = upright();
    start.position.y() = y;
    start.position.z() += ground;
    start.linear_velocity.x() = speed;
    start.joint_velocity[models::index(Servo::left_wheel)] = speed / 0.05;
    start.joint_velocity[models::index(Servo::right_wheel)] = -speed / 0.05;
    simulator_->reset(start);
    legs_ = stiff_legs(start);
  }

  void roll(int steps, const std::function<void()>& observe = {}) {
    for (int i = 0; i < steps; ++i) {
      const double couple =
          20.0 * simulator_->observation().yaw + 4.0 * simulator_->observation().yaw_rate;
      const std::array<ExternalWrench, 4> wrenches = {
          pushed_at({0.0, 0.0, 0.2}), pushed_at({0.0, 0.0, -0.4}),
          ExternalWrench{{couple, 0.0, 0.0}, {0.0, 0.5, 0.0}},
          ExternalWrench{{-couple, 0.0, 0.0}, {0.0, -0.5, 0.0}}};
      simulator_->step(legs_, wrenches);
      if (observe) observe();
    }
  }

  /// Rolls on; the largest difference of the left wheel's load from half the weight, relative to
  /// it.
  double ripple(int steps) {
    const double half_weight = 0.5 * g * motion(simulator_->model(), upright()).mass;
    double largest = 0.0;
    roll(steps, [&] {
      const double force = simulator_->ground_truth().wheel_normal_force[0];
      largest = std::max(largest, std::abs(force - half_weight) / half_weight);
    });
    return largest;
  }

  const Simulator& simulator() const { return *simulator_; }
  /// Lean to the left (rad).
  double lean() const {
    const Eigen::Vector3d left = simulator_->state().orientation * Eigen::Vector3d::UnitY();
    return -std::asin(left.z());
  }
  /// Lateral position of the midpoint between the wheels (m).
  double y() const {
    const Eigen::Vector3d axle(0.0, 0.0, -0.507);
    return (simulator_->state().position + simulator_->state().orientation * axle).y();
  }

 private:
  static constexpr double speed = 0.5;  // m/s

  ExternalWrench pushed_at(const Eigen::Vector3d& point) const {
    const RobotState& state = simulator_->state();
    const Eigen::Vector3d arm = state.orientation * point;
    const Eigen::Vector3d velocity = state.linear_velocity + state.angular_velocity.cross(arm);
    const double lag = speed * simulator_->observation().time - state.position.x() - arm.x();
    return {{400.0 * lag + 80.0 * (speed - velocity.x()), 0.0, 0.0}, point};
  }

  std::unique_ptr<Simulator> simulator_;
  models::Action legs_;
};

TEST_P(TyreOfRubber, RollsAsSmoothlyAsASphere) {
  Roller roller(make(robot_called("upkie_rubber.yaml")), 0.0, 0.0);
  Roller sphere(make(robot_called("upkie.xml", {},
                                  [](auto& robot) { robot.tyre.law = Tyre::Law::spring_damper; })),
                0.0, 0.0);
  roller.roll(500);
  sphere.roll(500);
  EXPECT_LT(roller.ripple(1000), sphere.ripple(1000) + 0.001);
  EXPECT_LT(std::abs(roller.y()), 1e-4);
  EXPECT_NEAR(roller.simulator().state().position.x(), sphere.simulator().state().position.x(),
              1e-4);
  const std::size_t wheel = models::index(Servo::left_wheel);
  EXPECT_NEAR(roller.simulator().state().joint_velocity[wheel],
              sphere.simulator().state().joint_velocity[wheel], 0.01);
}

TEST_P(TyreOfRubber, RollsSmoothlyOverJointsOfTheGround) {
  Terrain terrain;
  terrain.start_x = -1.0;
  terrain.pieces = {models::Flat{1.5}, models::Flat{3.0}, models::Step{.drop = 0.25}};
  Roller roller(make(robot_called("upkie_rubber.yaml", terrain)), 0.0, 0.25);
  roller.roll(700);
  EXPECT_LT(roller.ripple(600), 0.01) << "over the joint at x = 0.5 m";
  EXPECT_GT(roller.simulator().state().position.x(), 0.6);
}

TEST_P(TyreOfRubber, IsCarriedByAnEdgeBelowAnyPartOfItsWidth) {
  for (const double carried : {0.015, 0.002}) {  // of 40 mm of the left wheel's tyre
    const double edge = 0.2;
    Terrain terrain;
    terrain.start_x = -1.0;
    terrain.width = 2.0 * edge;
    terrain.pieces = {models::Flat{4.0}, models::Step{.drop = 0.25}};
    Roller roller(make(robot_called("upkie_rubber.yaml", terrain)),
                  edge + 0.02 - carried - half_track, 0.25);
    const double start = roller.y();
    roller.roll(1000);
    EXPECT_LT(std::abs(roller.lean()), 0.02) << carried;
    EXPECT_LT(std::abs(roller.y() - start), 0.01) << carried;
    const auto& force = roller.simulator().ground_truth().wheel_normal_force;
    EXPECT_NEAR(force[0] + force[1], 52.4, 2.0) << carried;
    EXPECT_GT(force[0], 20.0) << carried;
  }
}

INSTANTIATE_TEST_SUITE_P(Engine, TyreOfRubber, ::testing::ValuesIn(simulator_names()), engine_name);

TEST(TyreParity, LandingOfACrouchedRobot) {
  const auto model = robot_called("upkie_rubber.yaml");
  RobotState crouched;
  crouched.joint_position = {0.455, -0.791, 0.0, -0.455, 0.791, 0.0};
  crouched.position.z() = 0.05 + 0.164 + 0.168 * std::cos(0.455) + 0.175 * std::cos(0.336);
  models::Action legs = stiff_legs(crouched);
  for (models::ServoCommand& servo : legs.servo) servo.kp_scale *= 0.2;
  const Landing mujoco = landing_of(*make_simulator("mujoco", model, {}), crouched, 0.25, legs);
  const Landing bullet = landing_of(*make_simulator("bullet", model, {}), crouched, 0.25, legs);
  EXPECT_NEAR(mujoco.peak, bullet.peak, 0.03 * bullet.peak);
  EXPECT_NEAR(mujoco.rebound, bullet.rebound, 0.05 * bullet.rebound);
  EXPECT_GT(bullet.peak, 100.0);
}

}  // namespace
}  // namespace touchdown::simulators
