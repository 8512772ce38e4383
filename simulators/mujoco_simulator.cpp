#include <cmath>
#include <limits>
#include <new>
#include <optional>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "simulators/collision_model.hpp"
#include "simulators/engines.hpp"
#include "simulators/tyres.hpp"

namespace touchdown::simulators {

namespace {

models::MjModelPtr copy_with_options(const models::RobotModel& model,
                                     const SimulatorOptions& options) {
  models::MjModelPtr mj = collision_model(*model.mj);
  mj->opt.timestep = 1e-6 * static_cast<double>(options.steps.physics_us);
  for (int geom = 0; geom < mj->ngeom; ++geom) {
    mj->geom_solref[mjNREF * geom] = options.contact.solref_time_constant;
    mj->geom_solref[mjNREF * geom + 1] = options.contact.solref_damping_ratio;
  }
  return mj;
}

/// Whether MuJoCo found infinite or huge numbers; it then resets to the first pose.
bool diverged(const mjData& data) {
  return data.warning[mjWARN_BADQPOS].number + data.warning[mjWARN_BADQVEL].number +
             data.warning[mjWARN_BADQACC].number >
         0;
}

}  // namespace

// The classes below have external linkage: in an anonymous namespace g++ inlines them otherwise and
// contracts other products into sums, which changes the last bits of simulated runs.

/// The tyres of a robot in MuJoCo.
class MujocoTyres {
 public:
  /// `engine_model` may have fewer geoms than the robot's model.
  MujocoTyres(const models::RobotModel& robot, const mjModel& engine_model);

  /// The wheel with a tyre that contains this geom of the engine's model, if any.
  std::optional<std::size_t> wheel_of(int geom) const {
    return wheel_of_geom_[static_cast<std::size_t>(geom)];
  }

  /// Makes tyre contacts springs and dampers; called between `mj_step1` and `mj_step2`. A row of
  /// MuJoCo's solver has the force f = (a_ref − a)/R, with the acceleration a that f itself
  /// changes. With R = 1/(c·h) and a_ref = R·(k·δ + c·δ̇) it is
  ///
  ///     f = k·δ + c·(δ̇ − h·a)
  ///
  /// the damper at the end of a step h, which is stable for any c. Only normal rows are changed.
  /// Friction stays MuJoCo's, within the friction cone of that force.
  void press(mjData& data) const;

 private:
  models::Tyre tyre_;
  double share_;   ///< of one strip in its tyre
  double period_;  ///< of a physics step (s)
  std::vector<std::optional<std::size_t>> wheel_of_geom_;
};

/// MuJoCo as a `Simulator`: it steps a copy of the compiled model.
class MujocoSimulator : public Simulator {
 public:
  MujocoSimulator(const std::shared_ptr<const models::RobotModel>& model,
                  const SimulatorOptions& options);

  std::string_view name() const override { return "mujoco"; }

 protected:
  void place(const RobotState& start) override;
  void advance(const AppliedTorques& torques, std::span<const ExternalWrench> wrenches) override;
  void read(RobotState& state) const override;
  void read(ContactForces& forces) const override;

 private:
  /// The model that the engine steps: without geoms that cannot collide, and with the time step and
  /// the contact model of the options.
  models::MjModelPtr mj_;
  models::MjDataPtr data_;
  MujocoTyres tyres_;
  Eigen::Vector3d base_com_;  ///< centre of mass of the base body in its frame (m)
};

MujocoTyres::MujocoTyres(const models::RobotModel& robot, const mjModel& engine_model)
    : tyre_(robot.tyre),
      share_(1.0 / static_cast<double>(tyre_.strips().size())),
      period_(engine_model.opt.timestep),
      wheel_of_geom_(static_cast<std::size_t>(engine_model.ngeom)) {
  for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
    for (const int strip : robot.tyre_strips[wheel]) {
      // The engine's model has the geoms that collide, in their order.
      std::size_t number = 0;
      for (int geom = 0; geom < strip; ++geom) number += collides(*robot.mj, geom) ? 1 : 0;
      wheel_of_geom_.at(number) = wheel;
    }
  }
}

void MujocoTyres::press(mjData& data) const {
  std::vector<TyreContact> contacts;
  std::vector<int> numbers;
  for (int i = 0; i < data.ncon; ++i) {
    const mjContact& contact = data.contact[i];
    const bool first = wheel_of(contact.geom1).has_value();
    if (contact.efc_address < 0 || (!first && !wheel_of(contact.geom2))) continue;
    contacts.push_back({.strip = static_cast<std::size_t>(first ? contact.geom1 : contact.geom2),
                        .depth = contact.includemargin - contact.dist,
                        .normal = (first ? -1.0 : 1.0) * models::vector_at(contact.frame, 0)});
    numbers.push_back(i);
  }

  constexpr double none = -1e6;  // N: a pull, which gives no contact force
  const std::vector<bool> counts = counted_contacts(contacts);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    mjContact& contact = data.contact[numbers[i]];
    const int row = contact.efc_address;
    const double damping = share_ * tyre_.damping;
    const double force = share_ * tyre_.stiffness * contacts[i].depth - damping * data.efc_vel[row];
    data.efc_R[row] = 1.0 / (damping * period_);
    data.efc_D[row] = 1.0 / data.efc_R[row];
    data.efc_aref[row] = data.efc_R[row] * (counts[i] ? force : none);
    // The friction cone of MuJoCo's solver, scaled by both rows' R.
    contact.mu = contact.friction[0] * std::sqrt(data.efc_R[row + 1] / data.efc_R[row]);
  }
}

MujocoSimulator::MujocoSimulator(const std::shared_ptr<const models::RobotModel>& model,
                                 const SimulatorOptions& options)
    : Simulator(model, options),
      mj_(copy_with_options(*model, this->options())),
      data_(models::make_data(*mj_)),
      tyres_(*model, *mj_),
      base_com_(models::vector_at(mj_->body_ipos, model->base_body)) {}

void MujocoSimulator::place(const RobotState& start) {
  mj_resetData(mj_.get(), data_.get());
  models::write_pose(model(), start.position, start.orientation, start.joint_position, data_->qpos);
  // The angular velocity of a free joint is in its own frame, the linear one in the world's.
  Eigen::Map<Eigen::Matrix<mjtNum, 6, 1>> velocity(&data_->qvel[model().base_dof()]);
  velocity << start.linear_velocity, start.orientation.conjugate() * start.angular_velocity;
  for (std::size_t i = 0; i < models::servo_count; ++i) {
    if (!model().has(i)) continue;
    data_->qvel[model().dof_address[i]] = start.joint_velocity[i];
  }
  for (std::size_t i = 0; i < start.other_position.size(); ++i) {
    data_->qpos[mj_->jnt_qposadr[others()[i]]] = start.other_position[i];
    data_->qvel[mj_->jnt_dofadr[others()[i]]] = start.other_velocity[i];
  }
}

void MujocoSimulator::advance(const AppliedTorques& torques,
                              std::span<const ExternalWrench> wrenches) {
  for (std::size_t i = 0; i < models::servo_count; ++i) {
    const int joint = model().motor_joint[i];
    if (joint >= 0) data_->qfrc_applied[mj_->jnt_dofadr[joint]] = torques.servo[i];
  }
  for (std::size_t i = 0; i < torques.held.size(); ++i) {
    data_->qfrc_applied[model().held[i].dof_address] = torques.held[i];
  }
  Eigen::Map<Eigen::Matrix<mjtNum, 6, 1>> applied(
      &data_->xfrc_applied[6 * model().base_body]);  // at the base's centre of mass
  applied.setZero();
  for (const ExternalWrench& wrench : wrenches) {
    applied.head<3>() += wrench.force;
    applied.tail<3>() += torque_about(base_com_, wrench, state());
  }
  if (model().tyre.law == models::Tyre::Law::engine) {
    mj_step(mj_.get(), data_.get());
    return;
  }
  mj_step1(mj_.get(), data_.get());
  tyres_.press(*data_);
  mj_step2(mj_.get(), data_.get());
}

void MujocoSimulator::read(RobotState& state) const {
  if (diverged(*data_)) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    state.position.fill(nan);
    state.linear_velocity.fill(nan);
    return;
  }
  const mjtNum* q = &data_->qpos[model().base_qpos()];
  const mjtNum* v = &data_->qvel[model().base_dof()];
  state.position = models::vector_at(q, 0);
  state.orientation = models::quaternion_at(q + 3, 0);
  state.linear_velocity = models::vector_at(v, 0);
  state.angular_velocity = state.orientation * models::vector_at(v, 1);
  for (std::size_t i = 0; i < models::servo_count; ++i) {
    if (!model().has(i)) continue;
    state.joint_position[i] = data_->qpos[model().qpos_address[i]];
    state.joint_velocity[i] = data_->qvel[model().dof_address[i]];
  }
  state.other_position.clear();
  state.other_velocity.clear();
  for (const int joint : others()) {
    state.other_position.push_back(data_->qpos[mj_->jnt_qposadr[joint]]);
    state.other_velocity.push_back(data_->qvel[mj_->jnt_dofadr[joint]]);
  }
}

void MujocoSimulator::read(ContactForces& forces) const {
  // After mj_step the contacts are those of the state before it, which acted during the step.
  forces = {};
  for (int i = 0; i < data_->ncon; ++i) {
    const mjContact& contact = data_->contact[i];
    const bool first_is_terrain = mj_->geom_bodyid[contact.geom1] == 0;
    const int other = first_is_terrain ? contact.geom2 : contact.geom1;
    if (!first_is_terrain && mj_->geom_bodyid[contact.geom2] != 0) continue;
    mjtNum wrench[6];
    mj_contactForce(mj_.get(), data_.get(), i, wrench);
    if (const auto wheel = tyres_.wheel_of(other)) {
      forces.wheel_normal_force[*wheel] += wrench[0];
    } else if (wrench[0] > 0.0) {
      forces.body_touches_terrain = true;
    }
  }
}

std::unique_ptr<Simulator> make_mujoco(const std::shared_ptr<const models::RobotModel>& model,
                                       const SimulatorOptions& options) {
  return std::make_unique<MujocoSimulator>(model, options);
}

}  // namespace touchdown::simulators
