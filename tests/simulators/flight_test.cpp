#include "tests/simulators/bodies.hpp"
#include "tests/simulators/upkie.hpp"

namespace touchdown::simulators {
namespace {

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

class ExternalWrenchOn : public EveryEngine {};

TEST_P(ExternalWrenchOn, AFreeRobotAcceleratesItsCentreByForceOverMass) {
  const auto simulator = make(upkie(without_gravity), steps_of(1));
  Draws draw(2);
  for (int i = 0; i < 10; ++i) {
    const RobotState start = random_state(draw);
    const ExternalWrench wrench = {draw.vector(40.0), draw.vector(0.2)};
    simulator->reset(start);
    const Motion before = motion(simulator->model(), simulator->state());
    simulator->step(torques(), wrench);
    const Motion after = motion(simulator->model(), simulator->state());
    // The change of momentum that the integrator itself makes in one step, without the wrench.
    simulator->reset(start);
    simulator->step(torques());
    const Motion idle = motion(simulator->model(), simulator->state());
    const double h = simulator->control_period();
    const Eigen::Vector3d pull = (after.momentum - idle.momentum) / h;
    const Eigen::Vector3d turn = (after.spin - idle.spin) / h;
    const Eigen::Vector3d lever =
        start.position + start.orientation * wrench.point_in_base - before.centre_of_mass;
    EXPECT_LT((pull - wrench.force).norm(), 1e-4 * wrench.force.norm());
    EXPECT_LT((turn - lever.cross(wrench.force)).norm(), 1e-3 * lever.norm() * wrench.force.norm());
  }
}

TEST_P(ExternalWrenchOn, TheCentreOfMassHoldsARobotAgainstGravity) {
  const auto model = upkie();
  const auto simulator = make(model);
  const RobotState start = at_height(3.0);
  const Motion before = motion(*model, start);
  simulator->reset(start);
  const models::Action hold = stiff_legs(start);
  for (int i = 0; i < 1000; ++i) {
    const RobotState& state = simulator->state();
    const ExternalWrench wrench = {
        Eigen::Vector3d(0.0, 0.0, 9.81 * before.mass),
        state.orientation.conjugate() * (motion(*model, state).centre_of_mass - state.position)};
    simulator->step(hold, wrench);
  }
  const Motion after = motion(*model, simulator->state());
  EXPECT_LT((after.centre_of_mass - before.centre_of_mass).norm(), 1e-4);
  EXPECT_LT(after.momentum.norm(), 1e-3);
}

TEST_P(ExternalWrenchOn, DoesNotOutliveItsStep) {
  const auto simulator = make(upkie(without_gravity));
  simulator->reset(at_height(3.0));
  simulator->step(torques(), {Eigen::Vector3d(10.0, 0.0, 0.0), Eigen::Vector3d::Zero()});
  const double pushed = motion(simulator->model(), simulator->state()).momentum.x();
  for (int i = 0; i < 10; ++i) simulator->step(torques());
  EXPECT_NEAR(pushed, 10.0 * 1e-3, 1e-5);
  EXPECT_NEAR(motion(simulator->model(), simulator->state()).momentum.x(), pushed, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Engine, ExternalWrenchOn, ::testing::ValuesIn(simulator_names()),
                         engine_name);

using Accelerations = Eigen::Matrix<double, 6 + models::servo_count, 1>;

/// Accelerations of the base (linear, angular) and the joints, over one microsecond.
Accelerations accelerations(Simulator& simulator, const RobotState& start,
                            const JointTorques& torque) {
  simulator.reset(start);
  simulator.step(torques(torque));
  const RobotState& after = simulator.state();
  Accelerations a;
  a.segment<3>(0) = after.linear_velocity - start.linear_velocity;
  a.segment<3>(3) = after.angular_velocity - start.angular_velocity;
  for (std::size_t i = 0; i < models::servo_count; ++i) {
    a[6 + static_cast<int>(i)] = after.joint_velocity[i] - start.joint_velocity[i];
  }
  return a / simulator.control_period();
}

TEST(Acceleration, IsTheSameInBothEnginesInAnyState) {
  const auto model = upkie();
  const auto mujoco = make_simulator("mujoco", model, steps_of(1));
  const auto bullet = make_simulator("bullet", model, steps_of(1));
  Draws draw(3);
  for (int i = 0; i < 50; ++i) {
    const RobotState state = random_state(draw);
    JointTorques torque;
    for (std::size_t j = 0; j < models::servo_count; ++j) {
      torque[j] = draw.between(-model->effort[j], model->effort[j]);
    }
    const Accelerations one = accelerations(*mujoco, state, torque);
    const Accelerations other = accelerations(*bullet, state, torque);
    EXPECT_LT((one - other).head<6>().norm(), 1e-5 * one.head<6>().norm()) << i;
    EXPECT_LT((one - other).tail<models::servo_count>().norm(),
              1e-11 * one.tail<models::servo_count>().norm())
        << i;
  }
}

}  // namespace
}  // namespace touchdown::simulators
