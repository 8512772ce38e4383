#include <numbers>

#include <fmt/format.h>

#include "tests/scratch_folder.hpp"
#include "tests/simulators/bodies.hpp"
#include "tests/simulators/upkie.hpp"

namespace touchdown::simulators {
namespace {

class Contact : public EveryEngine {};

TEST_P(Contact, StandingWheelsCarryTheWeight) {
  const auto simulator = make(upkie());
  simulator->reset(upright());
  stand(*simulator, 3.0);
  const models::GroundTruth& truth = simulator->ground_truth();
  const double weight = 9.81 * motion(simulator->model(), simulator->state()).mass;
  EXPECT_NEAR(truth.wheel_normal_force[0] + truth.wheel_normal_force[1], weight, 1e-7 * weight);
  EXPECT_NEAR(truth.wheel_normal_force[0], 0.5 * weight, 0.02 * weight);
  EXPECT_FALSE(truth.body_touches_terrain);
  // Soft ground gives way, but little.
  EXPECT_NEAR(simulator->state().position.z(), 0.557, 1.5e-3);
}

TEST_P(Contact, TheForceIsAveragedOverTheControlStep) {
  SimulatorOptions options;
  options.steps = {1000, 5000};
  const auto coarse = make(upkie(), options);
  const auto fine = make(upkie());
  RobotState start = upright();
  start.position.z() += 0.05;
  coarse->reset(start);
  fine->reset(start);
  // The legs are limp, because servos that update at different rates differ.
  double largest = 0.0;
  for (int i = 0; i < 30; ++i) {
    std::array<double, models::wheel_count> sum = {};
    for (int j = 0; j < 5; ++j) {
      fine->step(torques());
      for (std::size_t w = 0; w < models::wheel_count; ++w) {
        sum[w] += fine->ground_truth().wheel_normal_force[w];
      }
    }
    coarse->step(torques());
    for (std::size_t w = 0; w < models::wheel_count; ++w) {
      largest = std::max(largest, sum[w]);
      EXPECT_DOUBLE_EQ(coarse->ground_truth().wheel_normal_force[w], sum[w] / 5.0);
    }
  }
  EXPECT_GT(largest, 100.0);
}

TEST_P(Contact, ThereIsNoContactInTheAir) {
  const auto simulator = make(upkie());
  simulator->reset(at_height(2.0));
  for (int i = 0; i < 100; ++i) {
    simulator->step(torques());
    ASSERT_EQ(simulator->ground_truth().wheel_normal_force, (std::array<double, 2>{0.0, 0.0}));
    ASSERT_FALSE(simulator->ground_truth().body_touches_terrain);
  }
}

TEST_P(Contact, ATorsoOnTheFloorIsNotAWheel) {
  const auto simulator = make(upkie());
  RobotState lying = at_height(0.3);
  lying.orientation = Eigen::AngleAxisd(1.5, Eigen::Vector3d::UnitY());
  simulator->reset(lying);
  bool touched = false;
  for (int i = 0; i < 1000 && !touched; ++i) {
    simulator->step(stiff_legs(lying));
    touched = simulator->ground_truth().body_touches_terrain;
  }
  EXPECT_TRUE(touched);
}

TEST_P(Contact, APartTouchesAtItsOwnHeight) {
  ScratchFolder folder;
  const std::string mesh = "type=\"mesh\" mesh=\"pad\" ";
  const std::string tilted = "euler=\"0.7853981634 0 0\" ";
  const std::string cube = "-1 -1 -1 1 -1 -1 -1 1 -1 1 1 -1 -1 -1 1 1 -1 1 -1 1 1 1 1 1";
  struct Part {
    std::string geom, vertices = "0 0 -1 1 1 1 -1 1 1 1 -1 1 -1 -1 1";
    double bottom = 0.02;  // m below its middle
  };
  for (const Part& part :
       {Part{mesh, cube}, Part{mesh}, Part{mesh, "3 0 -1 -3 0 -1 0 .1 -1 0 0 -.9"},
        Part{tilted + "type=\"box\" size=\".05 .02 .02\"", cube, 0.02 * std::numbers::sqrt2},
        Part{tilted + "type=\"cylinder\" size=\".03 .01\"", cube, 0.04 / std::numbers::sqrt2}}) {
    const auto file = folder.write(
        "robot.xml",
        edited_upkie({{"<asset>", fmt::format("<asset><mesh name=\"pad\" scale=\".02 .02 .02\" "
                                              "vertex=\"{}\"/>",
                                              part.vertices)},
                      {"<site name=\"imu\"",
                       "<geom class=\"collider\" " + part.geom + " pos=\"0 0 -0.7\"/>$&"}}));
    const auto simulator = make(
        std::make_shared<models::RobotModel>(models::compile_robot_model(file, models::Terrain{})));
    const double bottom = 0.7 + part.bottom;  // m below the base
    simulator->reset(at_height(bottom + 0.0005));
    double height = 0.0;
    for (int i = 0; i < 100 && !simulator->ground_truth().body_touches_terrain; ++i) {
      height = simulator->state().position.z() - bottom;
      simulator->step(torques());
    }
    EXPECT_TRUE(simulator->ground_truth().body_touches_terrain);
    EXPECT_NEAR(height, 0.0, 3e-4) << part.geom;
  }
}

/// Height above an edge of the ground (m) at which the tyres touch it, with their axle this far
/// beyond it.
double height_at_edge(Simulator& simulator, double beyond, double edge_height) {
  const double base_above_axle = upright().position.z() - 0.05;
  for (double height = 0.05; height > 0.0; height -= 1e-4) {
    RobotState start = at_height(base_above_axle + edge_height + height);
    start.position.x() = beyond;
    simulator.reset(start);
    simulator.step(torques());
    if (simulator.ground_truth().wheel_normal_force[0] > 0.0) return height;
  }
  return 0.0;
}

TEST_P(Contact, AnEdgeOfTheGroundIsSharp) {
  models::Terrain terrain;
  terrain.pieces = {models::Flat{2.0}, models::Step{.drop = 0.25, .nosing_radius = 0.0}};
  for (const bool rubber : {false, true}) {
    const auto robot = upkie(
        [&](models::RobotModel& model) {
          if (rubber) model.tyre.law = models::Tyre::Law::spring_damper;
        },
        terrain);
    for (const double beyond : {0.01, 0.03, 0.045}) {
      EXPECT_NEAR(height_at_edge(*make(robot), beyond, 0.25), std::sqrt(0.0025 - beyond * beyond),
                  4e-4)
          << beyond << ' ' << rubber;
    }
  }
}

TEST_P(Contact, FrictionIsThatOfTheTerrain) {
  // Sliding on locked wheels: the horizontal force on the robot is friction times load.
  for (const double friction : {0.2, 0.5}) {
    models::Terrain terrain;
    terrain.friction = friction;
    const auto simulator = make(upkie({}, terrain));
    RobotState start = upright();
    simulator->reset(start);
    stand(*simulator, 2.0);
    RobotState sliding = simulator->state();
    sliding.linear_velocity.y() += 1.0;  // sideways: wheels neither roll nor tip over the axle
    const auto model = upkie({}, terrain);
    const double before = motion(*model, sliding).momentum.y();
    const models::Action hold = locked(simulator->state());
    simulator->reset(sliding);
    double impulse = 0.0;
    for (int i = 0; i < 20; ++i) {
      simulator->step(hold);
      const auto& force = simulator->ground_truth().wheel_normal_force;
      impulse += (force[0] + force[1]) * simulator->control_period();
    }
    const double lost = before - motion(*model, simulator->state()).momentum.y();
    EXPECT_NEAR(lost, friction * impulse, 0.03 * friction * impulse);
  }
}

/// Difference of the wheel speeds (rad/s) without and with resistance.
double slowed_by(const Simulator& plain, const Simulator& resisting) {
  const auto speed = [](const Simulator& s) {
    return s.state().joint_velocity[models::index(models::Servo::left_wheel)] -
           s.state().joint_velocity[models::index(models::Servo::right_wheel)];
  };
  return 0.5 * (speed(plain) - speed(resisting));
}

TEST_P(Contact, RollingResistanceOpposesBothDirectionsAndIsNotReported) {
  for (const double speed : {1.0, -1.0}) {
    SimulatorOptions options;
    options.contact.rolling_resistance = 0.0;
    const auto plain = make(upkie(), options);
    options.contact.rolling_resistance = 0.004;
    const auto resisting = make(upkie(), options);
    RobotState start = upright();
    start.linear_velocity.x() = speed;
    start.joint_velocity[models::index(models::Servo::left_wheel)] = speed / 0.05;
    start.joint_velocity[models::index(models::Servo::right_wheel)] = -speed / 0.05;
    for (Simulator* simulator : {plain.get(), resisting.get()}) {
      simulator->reset(start);
      for (int i = 0; i < 200; ++i) {
        simulator->step(stiff_legs(start));
        ASSERT_EQ(simulator->observation().servo[models::index(models::Servo::left_wheel)].torque,
                  0.0);
      }
    }
    const double slowed = slowed_by(*plain, *resisting);
    EXPECT_GT(slowed * speed, 0.0);
    // By c·N/r, a rigid robot loses 0.004·g/r of wheel speed per second. Tipping changes that by a
    // factor, not in sign.
    EXPECT_GT(std::abs(slowed), 0.1 * 0.004 * 9.81 / (0.05 * 0.05) * 0.2);
    EXPECT_LT(std::abs(slowed), 10.0 * 0.004 * 9.81 / (0.05 * 0.05) * 0.2);
  }
}

TEST(EdgesInBullet, AreRoundedByAnOption) {
  models::Terrain terrain;
  terrain.pieces = {models::Flat{2.0}, models::Step{.drop = 0.25, .nosing_radius = 0.0}};
  const double beyond = 0.03;
  for (const double radius : {0.004, 0.008, 0.012}) {  // below a tenth of half the height
    SimulatorOptions options;
    options.contact.bullet_edge_radius = radius;
    const auto simulator = make_simulator("bullet", upkie({}, terrain), options);
    const double reach = 0.05 + radius;
    const double across = beyond + radius;
    EXPECT_NEAR(height_at_edge(*simulator, beyond, 0.25),
                std::sqrt(reach * reach - across * across) - radius, 4e-4)
        << radius;
  }
}

INSTANTIATE_TEST_SUITE_P(Engine, Contact, ::testing::ValuesIn(simulator_names()), engine_name);

}  // namespace
}  // namespace touchdown::simulators
