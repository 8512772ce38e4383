#include <algorithm>

#include <Eigen/LU>

#include "tests/simulators/upkie.hpp"

namespace touchdown::simulators {
namespace {

using models::vector_at;

class ClosedLegs : public EveryEngine {};

/// A shipped robot with closed legs.
std::shared_ptr<const models::RobotModel> closed_robot(const std::string& name) {
  return std::make_shared<models::RobotModel>(
      models::compile_robot_model(TOUCHDOWN_SOURCE_DIR "/models/" + name, models::Terrain{}));
}

/// The pose of the robot's file, its tyres this far above the ground (m).
RobotState above_ground(const models::RobotModel& model, double height) {
  const models::MjDataPtr data = models::at_reference(model);
  RobotState state;
  state.position.z() = height + model.wheel_radius + vector_at(data->xpos, model.base_body).z() -
                       vector_at(data->geom_xpos, model.tyre_geom[0]).z();
  for (std::size_t i = 0; i < models::servo_count; ++i) {
    state.joint_position[i] = model.reference(i);
  }
  return state;
}

/// MuJoCo's kinematics in a state of any engine.
models::MjDataPtr placed(const models::RobotModel& model, const RobotState& state) {
  const mjModel& mj = *model.mj;
  models::MjDataPtr data(mj_makeData(&mj));
  models::write_pose(model, state.position, state.orientation, state.joint_position, data->qpos);
  for (std::size_t i = 0; i < models::servo_count; ++i) {
    data->qpos[model.qpos_address[i]] = state.joint_position[i];
  }
  for (std::size_t i = 0; i < model.linked.size(); ++i) {
    data->qpos[mj.jnt_qposadr[model.linked[i]]] = state.other_position.at(i);
  }
  mj_kinematics(&mj, data.get());
  mj_comPos(&mj, data.get());
  return data;
}

/// The largest distance between two points that a loop joins (m).
double largest_gap(const models::RobotModel& model, const RobotState& state) {
  const mjModel& mj = *model.mj;
  const models::MjDataPtr data = placed(model, state);
  double largest = 0.0;
  for (int loop = 0; loop < mj.neq; ++loop) {
    const auto end = [&](int body, int number) -> Eigen::Vector3d {
      return vector_at(data->xpos, body) + models::quaternion_at(data->xquat, body) *
                                               vector_at(&mj.eq_data[mjNEQDATA * loop], number);
    };
    largest = std::max(largest, (end(mj.eq_obj1id[loop], 0) - end(mj.eq_obj2id[loop], 1)).norm());
  }
  return largest;
}

/// The vertical force on a wheel (N) that hip and knee of its own chain carry at rest. The other
/// bodies of the leg are no part of this chain.
double carried_by_chain(const Simulator& simulator, std::size_t leg) {
  const models::RobotModel& model = simulator.model();
  const mjModel& mj = *model.mj;
  const models::MjDataPtr data = placed(model, simulator.state());
  const int wheel = mj.jnt_bodyid[model.joint[3 * leg + 2]];
  const Eigen::Vector3d contact =
      vector_at(data->xpos, wheel) - model.wheel_radius * Eigen::Vector3d::UnitZ();
  std::vector<mjtNum> rates(3 * static_cast<std::size_t>(mj.nv));
  const auto rate = [&](int axis, std::size_t joint) {
    return rates[static_cast<std::size_t>(axis * mj.nv + model.dof_address[3 * leg + joint])];
  };
  Eigen::Vector2d load(-simulator.observation().servo[3 * leg].torque,
                       -simulator.observation().servo[3 * leg + 1].torque);
  for (int body = wheel; body != model.base_body; body = mj.body_parentid[body]) {
    mj_jacBodyCom(&mj, data.get(), rates.data(), nullptr, body);
    load += mj.body_mass[body] * g * Eigen::Vector2d(rate(2, 0), rate(2, 1));
  }
  mj_jac(&mj, data.get(), rates.data(), nullptr, contact.data(), wheel);
  Eigen::Matrix2d by_joint;
  by_joint << rate(0, 0), rate(2, 0), rate(0, 1), rate(2, 1);
  return (by_joint.inverse() * load).y();
}

TEST_P(ClosedLegs, StayClosedWhenTheRobotLands) {
  constexpr double drop = 0.2;  // m
  for (const auto& [name, most] : {std::pair("five_bar.yaml", 1e-4), {"four_bar.yaml", 2e-4}}) {
    const auto simulator = make(closed_robot(name));
    const models::RobotModel& model = simulator->model();
    simulator->reset(above_ground(model, drop));
    const models::Action action = locked(simulator->state());
    double largest = 0.0;
    double hardest = 0.0;
    for (int i = 0; i < 800; ++i) {
      simulator->step(action, guide(simulator->state()));
      largest = std::max(largest, largest_gap(model, simulator->state()));
      hardest = std::max(hardest, simulator->ground_truth().wheel_normal_force[0]);
    }
    EXPECT_LT(largest, most) << name;
    EXPECT_GT(hardest, 300.0) << name << " landed softly";
    EXPECT_LT(largest_gap(model, simulator->state()), 1e-4) << name << " stands";
  }
}

TEST_P(ClosedLegs, CarryTheWeightByTheirMotors) {
  for (const char* name : {"five_bar.yaml", "four_bar.yaml"}) {
    const auto simulator = make(closed_robot(name));
    const models::RobotModel& model = simulator->model();
    simulator->reset(above_ground(model, 0.0));
    stand(*simulator, 3.0);
    const models::GroundTruth& truth = simulator->ground_truth();
    const double weight = g * mj_getTotalmass(model.mj.get());
    EXPECT_NEAR(truth.wheel_normal_force[0] + truth.wheel_normal_force[1], weight, 1e-3 * weight);
    for (std::size_t leg = 0; leg < models::wheel_count; ++leg) {
      EXPECT_NEAR(carried_by_chain(*simulator, leg), truth.wheel_normal_force[leg], 0.5) << name;
    }
  }
}

TEST_P(ClosedLegs, TakeNoMoreThanTheLimitsOfTheirMotors) {
  for (const auto& [name, motors, limit] :
       {std::tuple("five_bar.yaml", 4U, 30.0), {"four_bar.yaml", 2U, 40.0}}) {
    const auto simulator = make(closed_robot(name));
    simulator->reset(above_ground(simulator->model(), 1.0));
    simulator->step(torques({500.0, 0.0, 0.0, -500.0, 0.0, 0.0}));
    const std::vector<models::ServoReading>& motor = simulator->observation().motor;
    ASSERT_EQ(motor.size(), motors) << name;
    EXPECT_DOUBLE_EQ(motor[0].torque, limit) << name;
    for (const models::ServoReading& reading : motor) {
      EXPECT_LE(std::abs(reading.torque), limit) << name;
    }
  }
}

TEST(ClosedLegsOfBothEngines, MoveAlikeInTheAir) {
  for (const char* name : {"five_bar.yaml", "four_bar.yaml"}) {
    const auto model = closed_robot(name);
    const auto mujoco = make_simulator("mujoco", model, steps_of(250));
    const auto bullet = make_simulator("bullet", model, steps_of(250));
    const RobotState start = above_ground(*model, 2.0);
    RobotState aim = start;
    aim.joint_position[0] += 0.2;
    aim.joint_position[1] -= 0.3;
    aim.joint_position[3] += 0.1;
    aim.joint_position[4] += 0.1;
    double moved = 0.0;
    for (Simulator* simulator : {mujoco.get(), bullet.get()}) simulator->reset(start);
    for (int i = 0; i < 800; ++i) {
      for (Simulator* simulator : {mujoco.get(), bullet.get()}) simulator->step(locked(aim));
      for (std::size_t j = 0; j < models::servo_count; ++j) {
        const double angle = mujoco->state().joint_position[j];
        ASSERT_NEAR(bullet->state().joint_position[j], angle, 3e-3) << name << i << ", joint " << j;
        moved = std::max(moved, std::abs(angle - start.joint_position[j]));
      }
      ASSERT_NEAR(bullet->state().position.z(), mujoco->state().position.z(), 1e-3) << name << i;
    }
    EXPECT_GT(moved, 0.1) << name;
    for (std::size_t i = 0; i < mujoco->observation().motor.size(); ++i) {
      EXPECT_NEAR(bullet->observation().motor[i].position, mujoco->observation().motor[i].position,
                  3e-3);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Engine, ClosedLegs, ::testing::ValuesIn(simulator_names()), engine_name);

}  // namespace
}  // namespace touchdown::simulators
