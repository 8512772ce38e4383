#include "simulators/simulator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "simulators/tyres.hpp"

namespace touchdown::simulators {

namespace {

/// Axes of the IMU's attitude reference system (x forward, y right, z down) in the world frame.
const Eigen::Vector3d world_to_ars(1.0, -1.0, -1.0);

/// Rolling resistance, proportional to the load and smooth at standstill.
double rolling_torque(double coefficient, double normal_force, double wheel_velocity) {
  return -coefficient * normal_force * std::tanh(wheel_velocity);
}

}  // namespace

Simulator::Simulator(std::shared_ptr<const models::RobotModel> model,
                     const SimulatorOptions& options)
    : model_(std::move(model)),
      options_(with_steps_for_tyres(options, *model_)),
      actuators_(*model_, options_.steps),
      held_servos_(*model_, options_.steps),
      imu_position_in_base_(model_->imu_position),
      imu_rotation_in_base_(models::imu_convention().toRotationMatrix()) {}

void Simulator::reset(const RobotState& start) {
  step_count_ = 0;
  forces_ = {};
  actuators_.reset();
  held_servos_.reset();
  place(start);
  read(state_);
  observe(imu_velocity(), {});
  if (!actuators_.are_ideal()) truth_.joint_torque.emplace();
}

void Simulator::step(const models::Action& action, std::span<const ExternalWrench> wrenches) {
  const Eigen::Vector3d velocity_before = truth_.imu_linear_velocity;
  const std::int64_t substeps = options_.steps.control_us / options_.steps.physics_us;
  std::array<double, models::wheel_count> force_sum = {0.0, 0.0};
  bool body_touched = false;
  const models::Action& commands = actuators_.delayed(action);
  Actuators::Torques torques;
  for (std::int64_t substep = 0; substep < substeps; ++substep) {
    torques = actuators_.step(commands, state_.joint_position, state_.joint_velocity);
    held_servos_.step(state_.held_position, state_.held_velocity);
    AppliedTorques applied{torques.applied, held_servos_.torques()};
    for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
      const std::size_t servo = models::index(models::wheel_servos[wheel]);
      applied.servo[servo] +=
          rolling_torque(options_.contact.rolling_resistance, forces_.wheel_normal_force[wheel],
                         state_.joint_velocity[servo]);
    }
    advance(applied, wrenches);
    read(state_);
    read(forces_);
    for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
      force_sum[wheel] += forces_.wheel_normal_force[wheel];
    }
    body_touched = body_touched || forces_.body_touches_terrain;
  }
  ++step_count_;
  observe(velocity_before, torques.reported);
  for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
    truth_.wheel_normal_force[wheel] = force_sum[wheel] / static_cast<double>(substeps);
  }
  truth_.body_touches_terrain = body_touched;
  if (!actuators_.are_ideal()) truth_.joint_torque = torques.applied;
}

Eigen::Vector3d Simulator::imu_velocity() const {
  return state_.linear_velocity +
         state_.angular_velocity.cross(state_.orientation * imu_position_in_base_);
}

void Simulator::observe(const Eigen::Vector3d& velocity_before,
                        const JointTorques& reported_torques) {
  const Eigen::Vector3d velocity = imu_velocity();
  const Eigen::Vector3d imu_acceleration = (velocity - velocity_before) / control_period();
  const Eigen::Matrix3d base_to_world = state_.orientation.toRotationMatrix();
  const Eigen::Matrix3d imu_to_world = base_to_world * imu_rotation_in_base_;
  const Eigen::Vector3d gravity = models::vector_at(model_->mj->opt.gravity, 0);

  observation_.time = static_cast<double>(step_count_) * control_period();
  for (std::size_t i = 0; i < models::servo_count; ++i) {
    observation_.servo[i] = {state_.joint_position[i], state_.joint_velocity[i],
                             reported_torques[i]};
  }
  observation_.imu.orientation =
      Eigen::Quaterniond(Eigen::Matrix3d(world_to_ars.asDiagonal() * imu_to_world));
  observation_.imu.angular_velocity = imu_to_world.transpose() * state_.angular_velocity;
  observation_.imu.linear_acceleration = imu_to_world.transpose() * imu_acceleration;
  observation_.imu.raw_linear_acceleration =
      imu_to_world.transpose() * (imu_acceleration - gravity);
  observation_.pitch = std::asin(std::clamp(-base_to_world(2, 0), -1.0, 1.0));
  observation_.pitch_rate = base_to_world.col(1).dot(state_.angular_velocity);
  observation_.yaw = std::atan2(base_to_world(1, 0), base_to_world(0, 0));
  observation_.yaw_rate = state_.angular_velocity.z();

  truth_ = {.base_position = state_.position,
            .base_orientation = state_.orientation,
            .base_linear_velocity = state_.linear_velocity,
            .base_angular_velocity = state_.angular_velocity,
            .imu_linear_velocity = velocity};
  observe_held_joints();
}

void Simulator::observe_held_joints() {
  for (std::size_t i = 0; i < state_.held_position.size(); ++i) {
    truth_.held.push_back(
        {state_.held_position[i], state_.held_velocity[i], held_servos_.torques()[i]});
  }
}

bool Simulator::healthy() const {
  constexpr double largest_position = 1e4;  // m
  constexpr double largest_velocity = 1e3;  // m/s and rad/s of the base; tenfold for the joints
  const auto within = [](const auto& numbers, double limit) {  // false if one is NaN
    return std::all_of(numbers.begin(), numbers.end(),
                       [&](double x) { return std::abs(x) <= limit; });
  };
  return state_.orientation.coeffs().allFinite() && within(state_.position, largest_position) &&
         within(state_.linear_velocity, largest_velocity) &&
         within(state_.angular_velocity, largest_velocity) &&
         within(state_.joint_position, std::numeric_limits<double>::max()) &&
         within(state_.joint_velocity, 10.0 * largest_velocity);
}

}  // namespace touchdown::simulators
