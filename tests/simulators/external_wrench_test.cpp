#include "tests/simulators/bodies.hpp"
#include "tests/simulators/upkie.hpp"

namespace touchdown::simulators {
namespace {

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

}  // namespace
}  // namespace touchdown::simulators
