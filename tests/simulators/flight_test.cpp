#include <numeric>

#include "simulators/bullet/world.hpp"
#include "tests/simulators/bodies.hpp"
#include "tests/simulators/upkie.hpp"

namespace touchdown::simulators {
namespace {

constexpr double upkie_mass = 5.33922;  // kg, from the robot's official description
TEST(Flight, BulletsLinksHaveTheMassOfTheRobot) {
  BulletWorld world(*upkie(), {});
  double mass = world.robot().getBaseMass();
  for (int link = 0; link < world.robot().getNumLinks(); ++link) {
    mass += world.robot().getLinkMass(link);
  }
  EXPECT_EQ(world.robot().getNumLinks(), models::servo_count);
  EXPECT_NEAR(mass, upkie_mass, 1e-5);
}

class Flight : public EveryEngine {};

/// Semi-implicit Euler adds h to the time of every velocity: z = z0 − g·h²·n·(n + 1)/2.
TEST_P(Flight, FreeFallMatchesSemiImplicitEuler) {
  const auto simulator = make(upkie());
  RobotState start = at_height(10.0);
  start.joint_position = {0.3, -0.6, 1.0, -0.3, 0.6, 2.0};
  simulator->reset(start);
  for (int n = 1; n <= 500; ++n) {
    simulator->step(torques());
    const double h = 1e-3;
    ASSERT_NEAR(simulator->state().position.z(), 10.0 - g * h * h * n * (n + 1) / 2, 1e-9) << n;
    ASSERT_NEAR(simulator->state().linear_velocity.z(), -g * h * n, 1e-9) << n;
  }
  EXPECT_NEAR(simulator->state().position.x(), 0.0, 1e-9);
  for (const double velocity : simulator->state().joint_velocity) EXPECT_NEAR(velocity, 0.0, 1e-9);
}

struct Drift {
  double momentum, spin, energy;
};

/// Relative change of conserved quantities over 0.15 s of tumbling with free joints.
Drift drift(Simulator& simulator, const RobotState& start) {
  simulator.reset(start);
  const Motion before = motion(simulator.model(), start);
  const double seconds = 0.15;
  const auto steps = std::lround(seconds / simulator.control_period());
  for (long i = 0; i < steps; ++i) simulator.step(torques());
  const Motion after = motion(simulator.model(), simulator.state());
  return {(after.momentum - before.momentum).norm() / before.momentum.norm(),
          (after.spin - before.spin).norm() / before.spin.norm(),
          std::abs(after.kinetic_energy / before.kinetic_energy - 1.0)};
}

TEST_P(Flight, ConservesMomentumAndEnergy) {
  const auto model = upkie(without_gravity);
  const auto coarse = make(model, steps_of(100));
  const auto fine = make(model, steps_of(10));
  Draws draw(1);
  for (int i = 0; i < 5; ++i) {
    RobotState start = random_state(draw);
    start.joint_position = {};  // far from the joint limits
    for (double& velocity : start.joint_velocity) velocity *= 0.5;
    const Drift rough = drift(*coarse, start);
    const Drift smooth = drift(*fine, start);
    EXPECT_LT(smooth.momentum, 2e-3);
    EXPECT_LT(smooth.spin, 2e-3);
    EXPECT_LT(smooth.energy, 2e-3);
    // The remaining drift is that of the integrator, proportional to the step.
    EXPECT_LT(smooth.momentum, 0.2 * rough.momentum + 1e-9);
    EXPECT_LT(smooth.spin, 0.2 * rough.spin + 1e-9);
    EXPECT_LT(smooth.energy, 0.2 * rough.energy + 1e-9);
  }
}

TEST_P(Flight, ServosCannotMoveTheCentreOfMass) {
  const auto simulator = make(upkie(without_gravity), steps_of(20));
  simulator->reset(at_height(5.0));
  const Motion before = motion(simulator->model(), simulator->state());
  for (int i = 0; i < 2500; ++i) {
    simulator->step(torques({4.0, -3.0, 0.5, -1.0, 2.0, 0.7}));
  }
  const Motion after = motion(simulator->model(), simulator->state());
  EXPECT_GT(after.kinetic_energy, 1.0);
  EXPECT_LT((after.centre_of_mass - before.centre_of_mass).norm(), 1e-4);
  const double scale = std::sqrt(2.0 * after.mass * after.kinetic_energy);  // kg·m/s
  EXPECT_LT(after.momentum.norm(), 1e-3 * scale);
  EXPECT_LT(after.spin.norm(), 1e-3 * scale);
}

INSTANTIATE_TEST_SUITE_P(Engine, Flight, ::testing::ValuesIn(simulator_names()), engine_name);

}  // namespace
}  // namespace touchdown::simulators
