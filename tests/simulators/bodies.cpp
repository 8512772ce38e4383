#include "tests/simulators/bodies.hpp"

#include <map>

namespace touchdown::simulators {

namespace {

struct Frame {
  Eigen::Vector3d position, velocity, angular_velocity;
  Eigen::Matrix3d rotation;
};

Eigen::Vector3d vector(const mjtNum* x, int row) {
  return {x[3 * row], x[3 * row + 1], x[3 * row + 2]};
}

Eigen::Matrix3d rotation(const mjtNum* q, int row) {
  return Eigen::Quaterniond(q[4 * row], q[4 * row + 1], q[4 * row + 2], q[4 * row + 3])
      .toRotationMatrix();
}

/// The frame of a body on a hinge, given its parent's.
Frame hinged(const mjModel& mj, int body, const Frame& parent, double angle, double rate) {
  const int joint = mj.body_jntadr[body];
  const Eigen::Vector3d axis = vector(mj.jnt_axis, joint);
  const Eigen::Vector3d pivot = vector(mj.jnt_pos, joint);
  const Eigen::Matrix3d at_rest = parent.rotation * rotation(mj.body_quat, body);
  Frame frame;
  frame.rotation = at_rest * Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  const Eigen::Vector3d arm = parent.rotation * vector(mj.body_pos, body) + at_rest * pivot;
  frame.angular_velocity = parent.angular_velocity + at_rest * axis * rate;
  frame.position = parent.position + arm - frame.rotation * pivot;
  frame.velocity = parent.velocity + parent.angular_velocity.cross(arm) -
                   frame.angular_velocity.cross(frame.rotation * pivot);
  return frame;
}

}  // namespace

Motion motion(const models::RobotModel& model, const RobotState& state) {
  const mjModel& mj = *model.mj;
  std::map<int, Frame> frames;
  frames[model.base_body] = {state.position, state.linear_velocity, state.angular_velocity,
                             state.orientation.toRotationMatrix()};
  for (int body = model.base_body + 1; body < mj.nbody; ++body) {
    const int address = mj.jnt_qposadr[mj.body_jntadr[body]];
    for (std::size_t i = 0; i < models::servo_count; ++i) {
      if (model.qpos_address[i] != address) continue;
      frames[body] = hinged(mj, body, frames.at(mj.body_parentid[body]), state.joint_position[i],
                            state.joint_velocity[i]);
    }
  }

  Motion sum;
  Eigen::Vector3d spin_about_origin = Eigen::Vector3d::Zero();
  for (const auto& [body, frame] : frames) {
    const double mass = mj.body_mass[body];
    const Eigen::Vector3d arm = frame.rotation * vector(mj.body_ipos, body);
    const Eigen::Vector3d position = frame.position + arm;
    const Eigen::Vector3d velocity = frame.velocity + frame.angular_velocity.cross(arm);
    const Eigen::Matrix3d axes = frame.rotation * rotation(mj.body_iquat, body);
    const Eigen::Vector3d own_spin = axes * vector(mj.body_inertia, body).asDiagonal() *
                                     axes.transpose() * frame.angular_velocity;
    sum.mass += mass;
    sum.centre_of_mass += mass * position;
    sum.momentum += mass * velocity;
    spin_about_origin += mass * position.cross(velocity) + own_spin;
    sum.kinetic_energy +=
        0.5 * (mass * velocity.squaredNorm() + own_spin.dot(frame.angular_velocity));
  }
  sum.centre_of_mass /= sum.mass;
  sum.spin = spin_about_origin - sum.centre_of_mass.cross(sum.momentum);
  return sum;
}

}  // namespace touchdown::simulators
