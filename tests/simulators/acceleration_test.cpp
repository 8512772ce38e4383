#include "tests/simulators/upkie.hpp"

namespace touchdown::simulators {
namespace {

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
