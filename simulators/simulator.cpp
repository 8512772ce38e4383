#include "simulators/simulator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "simulators/tyres.hpp"

namespace touchdown::simulators {

namespace {

/// Axes of the IMU's attitude reference system (x forward, y right, z down) in the world frame.
const Eigen::Vector3d world_to_ars(1.0, -1.0, -1.0);

/// Rolling resistance, proportional to the load and smooth at standstill.
double rolling_torque(double coefficient, double normal_force, double wheel_velocity) {
  return -coefficient * normal_force * std::tanh(wheel_velocity);
}

/// Where the cranks and rods of a leg are in `RobotState::other_position`.
std::size_t first_linked(const models::RobotModel& model, std::size_t leg) {
  return leg == 0 ? 0 : model.closed_leg[0]->joint.size() - 2;
}

/// One number per hinge of a closed leg, from those of the virtual legs and of cranks and rods.
LinkageVector of_hinges(const models::RobotModel& model, std::size_t leg,
                        const JointTorques& joints, const std::vector<double>& linked) {
  const std::size_t count = model.closed_leg[leg]->joint.size();
  LinkageVector of(static_cast<Eigen::Index>(count));
  of[0] = joints[3 * leg];
  of[1] = joints[3 * leg + 1];
  std::copy_n(linked.begin() + static_cast<std::ptrdiff_t>(first_linked(model, leg)), count - 2,
              of.data() + 2);
  return of;
}

/// A start with closed legs: cranks and rods follow hip and knee, with one motor also the knee.
RobotState with_closed_legs(const models::RobotModel& model, RobotState state) {
  state.other_position.clear();
  state.other_velocity.clear();
  for (std::size_t leg = 0; leg < models::wheel_count; ++leg) {
    const Linkage& linkage = model.closed_leg[leg]->linkage;
    double* const angle = &state.joint_position[3 * leg];
    double* const rate = &state.joint_velocity[3 * leg];
    LinkageVector q = linkage.start;
    if (!move_virtual_leg(linkage, angle[0], angle[1], q)) {
      throw InputError(model.name + ": the loops of its legs do not close at the start");
    }
    const MotorMap map(linkage, q);
    const LinkageVector rates = map.all * map.motor_rates({rate[0], rate[1]});
    std::copy_n(q.data(), 2, angle);
    std::copy_n(rates.data(), 2, rate);
    state.other_position.insert(state.other_position.end(), q.begin() + 2, q.end());
    state.other_velocity.insert(state.other_velocity.end(), rates.begin() + 2, rates.end());
  }
  return state;
}

}  // namespace

Simulator::Simulator(std::shared_ptr<const models::RobotModel> model,
                     const SimulatorOptions& options)
    : model_(std::move(model)),
      others_(model_->others()),
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
  place(model_->linked.empty() ? start : with_closed_legs(*model_, start));
  read(state_);
  observe(imu_velocity(), {});
  if (!actuators_.are_ideal()) truth_.joint_torque.emplace();
  observe_leg_motors({});
}

void Simulator::step(const models::Action& action, std::span<const ExternalWrench> wrenches) {
  const Eigen::Vector3d velocity_before = truth_.imu_linear_velocity;
  const std::int64_t substeps = options_.steps.control_us / options_.steps.physics_us;
  std::array<double, models::wheel_count> force_sum = {0.0, 0.0};
  bool body_touched = false;
  const models::Action& commands = actuators_.delayed(action);
  Actuators::Torques torques;
  for (std::int64_t substep = 0; substep < substeps; ++substep) {
    const bool has_loops = !model_->linked.empty();
    if (has_loops) update_leg_motors();
    torques = actuators_.step(commands, state_.joint_position, state_.joint_velocity,
                              has_loops ? &leg_motors_ : nullptr);
    const std::size_t linked = model_->linked.size();
    held_servos_.step(std::span(state_.other_position).subspan(linked),
                      std::span(state_.other_velocity).subspan(linked));
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
  observe(velocity_before, torques);
  for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
    truth_.wheel_normal_force[wheel] = force_sum[wheel] / static_cast<double>(substeps);
  }
  truth_.body_touches_terrain = body_touched;
  if (!actuators_.are_ideal()) truth_.joint_torque = at_virtual_legs(torques.applied);
  observe_leg_motors(torques.reported);
}

Eigen::Vector3d Simulator::imu_velocity() const {
  return state_.linear_velocity +
         state_.angular_velocity.cross(state_.orientation * imu_position_in_base_);
}

void Simulator::observe(const Eigen::Vector3d& velocity_before, const Actuators::Torques& torques) {
  const Eigen::Vector3d velocity = imu_velocity();
  const Eigen::Vector3d imu_acceleration = (velocity - velocity_before) / control_period();
  const Eigen::Matrix3d base_to_world = state_.orientation.toRotationMatrix();
  const Eigen::Matrix3d imu_to_world = base_to_world * imu_rotation_in_base_;
  const Eigen::Vector3d gravity = models::vector_at(model_->mj->opt.gravity, 0);

  observation_.time = static_cast<double>(step_count_) * control_period();
  observation_.imu.orientation =
      Eigen::Quaterniond(Eigen::Matrix3d(world_to_ars.asDiagonal() * imu_to_world));
  observation_.imu.angular_velocity = imu_to_world.transpose() * state_.angular_velocity;
  observation_.imu.linear_acceleration = imu_to_world.transpose() * imu_acceleration;
  observation_.imu.raw_linear_acceleration =
      imu_to_world.transpose() * (imu_acceleration - gravity);
  const JointTorques at_joints = at_virtual_legs(torques.reported);
  for (std::size_t i = 0; i < models::servo_count; ++i) {
    observation_.servo[i] = {state_.joint_position[i] + torques.play[i],
                             state_.joint_velocity[i] + torques.play_rate[i], at_joints[i]};
  }
  observation_.pitch = std::asin(std::clamp(-base_to_world(2, 0), -1.0, 1.0));
  observation_.pitch_rate = base_to_world.col(1).dot(state_.angular_velocity);
  observation_.yaw = std::atan2(base_to_world(1, 0), base_to_world(0, 0));
  observation_.yaw_rate = state_.angular_velocity.z();

  truth_ = {.base_position = state_.position,
            .base_orientation = state_.orientation,
            .base_linear_velocity = state_.linear_velocity,
            .base_angular_velocity = state_.angular_velocity,
            .imu_linear_velocity = velocity};
  for (std::size_t i = model_->linked.size(); i < others_.size(); ++i) {
    truth_.held.push_back({state_.other_position[i], state_.other_velocity[i],
                           held_servos_.torques()[i - model_->linked.size()]});
  }
}

void Simulator::update_leg_motors() {
  for (std::size_t leg = 0; leg < models::wheel_count; ++leg) {
    const std::vector<int>& motors = model_->closed_leg[leg]->linkage.motors;
    const auto q = of_hinges(*model_, leg, state_.joint_position, state_.other_position);
    const auto rates = of_hinges(*model_, leg, state_.joint_velocity, state_.other_velocity);
    leg_motors_.map[leg].emplace(model_->closed_leg[leg]->linkage, q);
    for (std::size_t i = 0; i < motors.size(); ++i) {
      leg_motors_.position[3 * leg + i] = q[motors[i]];
      leg_motors_.velocity[3 * leg + i] = rates[motors[i]];
    }
  }
}

JointTorques Simulator::at_virtual_legs(JointTorques torques) const {
  if (step_count_ == 0) return torques;
  const Eigen::Vector3d force = imu_rotation_in_base_ * observation_.imu.raw_linear_acceleration;
  for (std::size_t leg = 0; leg < models::wheel_count; ++leg) {
    if (!leg_motors_.map[leg]) continue;
    LinkageVector at_motors(leg_motors_.map[leg]->leg.cols());
    for (Eigen::Index i = 0; i < at_motors.size(); ++i) {
      at_motors[i] = torques[3 * leg + static_cast<std::size_t>(i)];
    }
    const Eigen::Vector2d at_joints =
        leg_motors_.map[leg]->leg_torques(at_motors, {force.x(), force.z()});
    torques[3 * leg] = at_joints[0];
    torques[3 * leg + 1] = at_joints[1];
  }
  return torques;
}

void Simulator::observe_leg_motors(const JointTorques& reported_torques) {
  observation_.motor.clear();
  if (model_->linked.empty()) return;
  update_leg_motors();
  for (std::size_t i = 0; i < models::servo_count; ++i) {
    if (i % 3 == 2 || model_->motor_joint[i] < 0) continue;
    observation_.motor.push_back(
        {leg_motors_.position[i], leg_motors_.velocity[i], reported_torques[i]});
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
