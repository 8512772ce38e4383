#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include <Eigen/Core>

#include "core/error.hpp"
#include "policies/policy.hpp"

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

}  // namespace

// The classes below have external linkage: in an anonymous namespace g++ inlines them otherwise and
// contracts other products into sums, which changes the last bits of simulated runs.

/// Masses and lengths of a wheeled biped from the side, x forward, z up, for control laws. Both
/// legs count as one. All joints are at zero, where both links point straight down.
struct SideView {
  double torso_mass = 0.0;       ///< kg
  double upper_mass = 0.0;       ///< of both legs (kg)
  double lower_mass = 0.0;       ///< of both legs (kg)
  double mass = 0.0;             ///< of the whole robot, wheels included (kg)
  Eigen::Vector2d torso_centre;  ///< centre of mass from the hip (m)
  Eigen::Vector2d upper_centre;  ///< centre of mass from the hip (m)
  Eigen::Vector2d lower_centre;  ///< centre of mass from the knee (m)
  double upper_length = 0.0;     ///< hip to knee (m)
  double lower_length = 0.0;     ///< knee to axle (m)
  /// Sign that makes hip and knee angles positive forward: left, right.
  std::array<double, 2> forward = {1.0, -1.0};

  /// Vector (m) from the axle to the centre of mass of the robot without wheels. The angles of
  /// hips, knees and torso are positive forward (rad).
  Eigen::Vector2d centre(double hip, double knee, double pitch) const;
};

namespace {

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

/// A balancer that uses contact. It differs from `WheelBalancer` in three ways:
/// - It balances the centre of mass, not the torso.
/// - In the air it keeps the ground speed on its wheels.
/// - It softens its knees for a landing, each leg along its own line. It also does so when one
///   wheel hangs over an edge, and sinks instead of tipping over the other wheel.
/// Wheel commands and gains are those of `WheelBalancer`. The effect of each part:
/// docs/explanation/policy.md.
class SoftLander : public Policy {
 public:
  SoftLander(PolicyParts parts, const SideView& robot)
      : parts_(std::move(parts)), robot_(robot), standing_(long_ago), on_ground_(long_ago) {}

  void reset(const models::Observation& observation) override;
  models::Action act(const models::Observation& observation) override;

 private:
  /// Whether both wheels have been without contact for longer than a false alarm.
  bool is_flying() const;
  void update_ground_velocity(const models::Observation& observation);
  void update_softness();
  void command_leg(std::size_t side, const models::Observation& observation,
                   models::Action& action) const;

  PolicyParts parts_;
  SideView robot_;

  std::array<bool, models::wheel_count> contact_ = {true, true};
  double held_velocity_ = 0.0;    ///< ground speed during the last contact (m/s)
  double integral_ = 0.0;         ///< m/s
  double ground_velocity_ = 0.0;  ///< commanded to the wheels (m/s)
  double in_air_ = 0.0;           ///< time since both wheels lost contact (s)
  double one_in_air_ = 0.0;       ///< time since either wheel lost contact (s)
  double standing_ = 0.0;         ///< time since the first contact after a flight (s)
  double on_ground_ = 0.0;        ///< time since both regained contact, bumps ignored (s)
  double softness_ = 0.0;         ///< of the legs: 0 is as stiff as on the ground, 1 is softest
  std::optional<models::Action> previous_;  ///< the last action
};

void SoftLander::reset(const models::Observation& observation) {
  *this = SoftLander(std::move(parts_), robot_);
  parts_.course.begin(observation, parts_.gains);
}

void SoftLander::update_ground_velocity(const models::Observation& observation) {
  const auto mean = [&](std::size_t joint) {
    return 0.5 * (robot_.forward[0] * observation.servo[joint].position +
                  robot_.forward[1] * observation.servo[3 + joint].position);
  };
  const Eigen::Vector2d centre = robot_.centre(mean(0), mean(1), observation.pitch);
  const double lean = std::atan2(centre.x(), centre.y());
  if (contact_[0] || contact_[1]) {
    const double gain = -std::expm1(-parts_.course.period / speed_low_pass);
    held_velocity_ += gain * (parts_.course.rolling_speed(observation) - held_velocity_);
  }
  if (!is_flying()) {
    const double position_error = parts_.course.target_position - parts_.course.position;
    integral_ = std::clamp(
        integral_ + parts_.course.period * (parts_.gains.position_stiffness * position_error -
                                            parts_.gains.pitch_stiffness * lean),
        -parts_.gains.max_integral, parts_.gains.max_integral);
    ground_velocity_ = parts_.gains.pitch_damping * lean -
                       parts_.gains.position_damping * position_error - integral_;
  } else {
    parts_.course.target_position = parts_.course.position;
    parts_.course.target_velocity = held_velocity_;
    integral_ = -held_velocity_;
    ground_velocity_ = parts_.gains.pitch_damping * lean + held_velocity_;
  }
  ground_velocity_ =
      std::clamp(ground_velocity_, -parts_.gains.max_velocity, parts_.gains.max_velocity);
}

bool SoftLander::is_flying() const { return in_air_ > dead_time; }

void SoftLander::update_softness() {
  standing_ = is_flying() ? 0.0 : standing_ + parts_.course.period;
  const double sinking = std::max(in_air_ - dead_time, one_in_air_ - one_dead_time);
  if (sinking > 0.0) {
    on_ground_ = 0.0;
    softness_ = std::max(softness_, std::min(sinking / softening_time, 1.0));
  } else {
    on_ground_ += parts_.course.period;
    if (on_ground_ > soft_time) {
      softness_ = std::max(0.0, softness_ - parts_.course.period / stiffening_time);
    }
  }
}

void SoftLander::command_leg(std::size_t side, const models::Observation& observation,
                             models::Action& action) const {
  const std::size_t hip = 3 * side;
  const std::size_t knee = hip + 1;
  const double forward = robot_.forward[side];
  const double stiff = 1.0 - softness_;
  const double target = forward * parts_.course.posture[knee];
  const double knee_angle = forward * observation.servo[knee].position;
  const LegLine line = line_of(robot_, knee_angle);
  const double square = line.lever * line.lever;
  const double load = !is_flying() ? softness_ * 0.5 * robot_.mass * gravity * line.lever *
                                         std::min(1.0, standing_ / load_ramp)
                                   : 0.0;
  action.servo[knee] = {.feedforward_torque = -forward * load,
                        .position = parts_.course.posture[knee],
                        .kp_scale = stiff * parts_.gains.leg_kp_scale +
                                    softness_ * soft_stiffness * square / models::servo_kp,
                        .kd_scale = stiff * parts_.gains.leg_kd_scale +
                                    softness_ * soft_damping * square / models::servo_kd};
  // The hip turns against the line, in proportion to the softness: the leg folds along its line.
  const double folded = stiff * target + softness_ * knee_angle;
  action.servo[hip] = {
      .position = parts_.course.posture[hip] +
                  forward * (line_of(robot_, target).angle - line_of(robot_, folded).angle),
      .velocity = -softness_ * line.angle_rate * observation.servo[knee].velocity,
      .kp_scale = parts_.gains.leg_kp_scale,
      .kd_scale = parts_.gains.leg_kd_scale};
}

models::Action SoftLander::act(const models::Observation& observation) {
  parts_.course.follow(observation, parts_.gains);
  contact_ = parts_.contact(observation, previous_ ? &*previous_ : nullptr);
  in_air_ = contact_[0] || contact_[1] ? 0.0 : in_air_ + parts_.course.period;
  one_in_air_ = contact_[0] && contact_[1] ? 0.0 : one_in_air_ + parts_.course.period;
  update_ground_velocity(observation);
  update_softness();
  models::Action action;
  for (std::size_t side = 0; side < models::wheel_count; ++side) {
    command_leg(side, observation, action);
  }
  // With both wheels in the air, the wheels cannot turn the robot.
  const double turn = !is_flying() ? parts_.course.yaw_torque(observation, parts_.gains) : 0.0;
  command_wheels(ground_velocity_, {turn, turn}, parts_.course.wheel_radius, parts_.gains, action);
  previous_ = action;
  return action;
}

std::unique_ptr<Policy> make_soft_lander(PolicyParts parts, const models::RobotModel& robot) {
  return std::make_unique<SoftLander>(std::move(parts), side_view(robot));
}

}  // namespace touchdown::policies
