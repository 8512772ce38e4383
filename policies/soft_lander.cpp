#include "policies/soft_lander.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.hpp"

namespace touchdown::policies {

namespace {

/// Rotates forward: a vector that points down moves to the front.
Eigen::Vector2d bent(double angle, const Eigen::Vector2d& v) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}

Eigen::Vector2d seen(const Eigen::Vector3d& v) { return {v.x(), v.z()}; }

struct Part {
  double mass = 0.0;       ///< kg
  Eigen::Vector2d centre;  ///< of mass (m)
};

/// The body that moves another one: the base, or that of the nearest servo above it. Bodies that
/// are fixed or held move with it.
int moved_with(const models::RobotModel& robot, int body) {
  const mjModel& mj = *robot.mj;
  for (; body != robot.base_body && body > 0; body = mj.body_parentid[body]) {
    if (mj.body_jntnum[body] == 0) continue;
    const int joint = mj.body_jntadr[body];
    if (std::find(robot.joint.begin(), robot.joint.end(), joint) != robot.joint.end()) break;
  }
  return body;
}

/// A body and all that move with it, at zero.
Part part_of(const models::RobotModel& robot, const mjData& data, int body) {
  const mjModel& mj = *robot.mj;
  Part part{mj.body_mass[body], seen(models::vector_at(data.xipos, body))};
  for (int other = 1; other < mj.nbody; ++other) {
    if (other == body || mj.body_mass[other] == 0.0 || moved_with(robot, other) != body) continue;
    const double share = mj.body_mass[other] / (part.mass + mj.body_mass[other]);
    part.centre += share * (seen(models::vector_at(data.xipos, other)) - part.centre);
    part.mass += mj.body_mass[other];
  }
  return part;
}

constexpr double long_ago = 1e3;          // s
constexpr double speed_low_pass = 0.02;   // s: of the ground speed
constexpr double dead_time = 0.06;        // s: a shorter flight counts as a false alarm
constexpr double one_dead_time = 0.1;     // s: a shorter flight of one wheel counts as a bump
constexpr double softening_time = 0.1;    // s: softening of the legs after the dead time
constexpr double soft_time = 0.25;        // s: soft phase after a landing
constexpr double stiffening_time = 0.4;   // s: stiffening afterwards
constexpr double load_ramp = 0.02;        // s: load ramp of the soft knees
constexpr double soft_stiffness = 500.0;  // N/m: of one soft leg from hip to axle
constexpr double soft_damping = 140.0;    // N·s/m
constexpr double gravity = 9.81;          // m/s²

/// The line from hip to axle of a leg with its knee bent forward.
struct LegLine {
  double lever;       ///< lever arm at the knee of a force along the line (m)
  double angle;       ///< of the line from the upper link, forward (rad)
  double angle_rate;  ///< derivative of the angle by the knee angle
};

LegLine line_of(const SideView& robot, double knee) {
  const double u = robot.upper_length;
  const double l = robot.lower_length;
  const double square = u * u + l * l + 2.0 * u * l * std::cos(knee);
  return {u * l * std::sin(knee) / std::sqrt(square),
          std::atan2(l * std::sin(knee), u + l * std::cos(knee)),
          (l * l + u * l * std::cos(knee)) / square};
}

}  // namespace

Eigen::Vector2d SideView::centre(double hip, double knee, double pitch) const {
  const Eigen::Vector2d to_knee = bent(hip, {0.0, -upper_length});
  const Eigen::Vector2d to_axle = to_knee + bent(hip + knee, {0.0, -lower_length});
  const Eigen::Vector2d moments = torso_mass * torso_centre + upper_mass * bent(hip, upper_centre) +
                                  lower_mass * (to_knee + bent(hip + knee, lower_centre));
  return bent(-pitch, moments / (torso_mass + upper_mass + lower_mass) - to_axle);
}

SideView side_view(const models::RobotModel& robot) {
  const mjModel& mj = *robot.mj;
  if (!robot.has(models::index(models::Servo::left_hip))) {
    throw InputError(robot.name + ": soft_landing: expected legs with hips");
  }
  const models::MjDataPtr data = models::at_zero(robot);
  const auto joint = [&](models::Servo servo) { return robot.joint[models::index(servo)]; };
  const auto anchor = [&](models::Servo servo) {
    return seen(models::vector_at(data->xanchor, joint(servo)));
  };
  const Part torso = part_of(robot, *data, robot.base_body);
  SideView view;
  view.torso_mass = torso.mass;
  view.mass = mj.body_subtreemass[robot.base_body];
  view.upper_centre = view.lower_centre = view.torso_centre = Eigen::Vector2d::Zero();
  for (std::size_t side = 0; side < models::wheel_count; ++side) {
    const auto hip = static_cast<models::Servo>(3 * side);
    const auto knee = static_cast<models::Servo>(3 * side + 1);
    const Part upper = part_of(robot, *data, mj.jnt_bodyid[joint(hip)]);
    const Part lower = part_of(robot, *data, mj.jnt_bodyid[joint(knee)]);
    const Eigen::Vector2d axle = seen(models::vector_at(data->geom_xpos, robot.tyre_geom[side]));
    view.upper_mass += upper.mass;
    view.lower_mass += lower.mass;
    view.torso_centre += 0.5 * (torso.centre - anchor(hip));
    view.upper_centre += 0.5 * (upper.centre - anchor(hip));
    view.lower_centre += 0.5 * (lower.centre - anchor(knee));
    view.upper_length += 0.5 * (anchor(knee) - anchor(hip)).norm();
    view.lower_length += 0.5 * (axle - anchor(knee)).norm();
    view.forward[side] = models::vector_at(data->xaxis, joint(hip)).y() < 0.0 ? 1.0 : -1.0;
  }
  return view;
}

SoftLander::SoftLander(const WheelBalancerConfig& config, Course course, const SideView& robot,
                       WheelContact contact)
    : config_(config),
      course_(std::move(course)),
      robot_(robot),
      contact_source_(std::move(contact)),
      standing_(long_ago),
      on_ground_(long_ago) {}

void SoftLander::reset(const models::Observation& observation) {
  *this = SoftLander(config_, std::move(course_), robot_, std::move(contact_source_));
  course_.begin(observation, config_);
}

void SoftLander::update_ground_velocity(const models::Observation& observation) {
  const auto mean = [&](std::size_t joint) {
    return 0.5 * (robot_.forward[0] * observation.servo[joint].position +
                  robot_.forward[1] * observation.servo[3 + joint].position);
  };
  const Eigen::Vector2d centre = robot_.centre(mean(0), mean(1), observation.pitch);
  const double lean = std::atan2(centre.x(), centre.y());
  if (contact_[0] || contact_[1]) {
    const double gain = -std::expm1(-course_.period / speed_low_pass);
    held_velocity_ += gain * (course_.rolling_speed(observation) - held_velocity_);
  }
  if (!is_flying()) {
    const double position_error = course_.target_position - course_.position;
    integral_ =
        std::clamp(integral_ + course_.period * (config_.position_stiffness * position_error -
                                                 config_.pitch_stiffness * lean),
                   -config_.max_integral, config_.max_integral);
    ground_velocity_ =
        config_.pitch_damping * lean - config_.position_damping * position_error - integral_;
  } else {
    course_.target_position = course_.position;
    course_.target_velocity = held_velocity_;
    integral_ = -held_velocity_;
    ground_velocity_ = config_.pitch_damping * lean + held_velocity_;
  }
  ground_velocity_ = std::clamp(ground_velocity_, -config_.max_velocity, config_.max_velocity);
}

bool SoftLander::is_flying() const { return in_air_ > dead_time; }

void SoftLander::update_softness() {
  standing_ = is_flying() ? 0.0 : standing_ + course_.period;
  const double sinking = std::max(in_air_ - dead_time, one_in_air_ - one_dead_time);
  if (sinking > 0.0) {
    on_ground_ = 0.0;
    softness_ = std::max(softness_, std::min(sinking / softening_time, 1.0));
  } else {
    on_ground_ += course_.period;
    if (on_ground_ > soft_time) {
      softness_ = std::max(0.0, softness_ - course_.period / stiffening_time);
    }
  }
}

void SoftLander::command_leg(std::size_t side, const models::Observation& observation,
                             models::Action& action) const {
  const std::size_t hip = 3 * side;
  const std::size_t knee = hip + 1;
  const double forward = robot_.forward[side];
  const double stiff = 1.0 - softness_;
  const double target = forward * course_.posture[knee];
  const double knee_angle = forward * observation.servo[knee].position;
  const LegLine line = line_of(robot_, knee_angle);
  const double square = line.lever * line.lever;
  const double load = !is_flying() ? softness_ * 0.5 * robot_.mass * gravity * line.lever *
                                         std::min(1.0, standing_ / load_ramp)
                                   : 0.0;
  action.servo[knee] = {.feedforward_torque = -forward * load,
                        .position = course_.posture[knee],
                        .kp_scale = stiff * config_.leg_kp_scale +
                                    softness_ * soft_stiffness * square / models::servo_kp,
                        .kd_scale = stiff * config_.leg_kd_scale +
                                    softness_ * soft_damping * square / models::servo_kd};
  // The hip turns against the line, in proportion to the softness: the leg folds along its line.
  const double folded = stiff * target + softness_ * knee_angle;
  action.servo[hip] = {.position = course_.posture[hip] + forward * (line_of(robot_, target).angle -
                                                                     line_of(robot_, folded).angle),
                       .velocity = -softness_ * line.angle_rate * observation.servo[knee].velocity,
                       .kp_scale = config_.leg_kp_scale,
                       .kd_scale = config_.leg_kd_scale};
}

models::Action SoftLander::act(const models::Observation& observation) {
  course_.follow(observation, config_);
  contact_ = contact_source_(observation, previous_ ? &*previous_ : nullptr);
  in_air_ = contact_[0] || contact_[1] ? 0.0 : in_air_ + course_.period;
  one_in_air_ = contact_[0] && contact_[1] ? 0.0 : one_in_air_ + course_.period;
  update_ground_velocity(observation);
  update_softness();
  models::Action action;
  for (std::size_t side = 0; side < models::wheel_count; ++side) {
    command_leg(side, observation, action);
  }
  // With both wheels in the air, the wheels cannot turn the robot.
  const double turn = !is_flying() ? course_.yaw_torque(observation, config_) : 0.0;
  command_wheels(ground_velocity_, {turn, turn}, course_.wheel_radius, config_, action);
  previous_ = action;
  return action;
}

}  // namespace touchdown::policies
