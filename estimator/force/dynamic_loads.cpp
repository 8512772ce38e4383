#include "estimator/force/dynamic_loads.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "estimator/force/servo_law.hpp"
#include "estimator/low_pass.hpp"

namespace touchdown {

namespace {

constexpr double gravity = 9.81;                 // m/s²
constexpr double time_constant = 0.003;          // s: of all motion and moments
constexpr double alignment = 0.0016;             // s: servos low-pass their velocities, not torques
constexpr double longer_with_noise = 0.001;      // s per m/s² of the accelerometer's noise
constexpr double most_acceleration_noise = 5.0;  // m/s², for which the low-pass lasts longer

// Errors that do not average out.
constexpr double torque_error = 0.0033;   // of the joints' torques, as a share of weight × length
constexpr double servo_share = 0.8;       // of that, by the servos' laws
constexpr double scale_error = 0.03;      // of the load: scales of torques, masses
constexpr double model_error = 0.0115;    // a share of the weight
constexpr double dynamic_error = 0.1;     // of the force that accelerates a leg
constexpr double forward_error = 0.0095;  // share of the weight: F_x of a leg without a hip
constexpr double largest_share = 0.25;    // of the weight: the largest known deviation

// Errors of both loads' sum by the accelerometer. Where the torques contradict it for less than
// `contradiction`, the accelerometer is wrong; for longer, a hand carries the robot.
constexpr double sum_error = 0.05;        // a share of the weight
constexpr double carried_share = 0.1;     // of the sum
constexpr double contradiction = 0.02;    // s
constexpr double carried_variance = 2.0;  // per squared contradiction

// Limits of the noise estimates; they are those of sensors, whatever the robot.
constexpr double noise_gain = 0.01;
constexpr double warm_up = 0.1;  // s

constexpr double straight = 1e-9;  // m², beside the Jacobian's determinant

double square(double x) noexcept { return x * x; }

}  // namespace

/// In the joints' own signs (N·m).
struct DynamicLoads::LegTorques {
  double hip;
  double knee;
  double wheel;

  [[nodiscard]] bool is_known() const noexcept { return std::isfinite(hip + knee + wheel); }
};

/// A load by the leg's own joints, and the leg's part in the sum of both loads.
struct DynamicLoads::LegLoad {
  double force = std::numeric_limits<double>::quiet_NaN();  ///< N
  double variance = 0.0;         ///< N², without what the vertical accelerometer's error adds
  double by_acceleration = 0.0;  ///< the error's factor (kg)
  double required = 0.0;  ///< N, by half of the robot that moves as the hip, and the leg's motion
};

DynamicLoads::DynamicLoads(const LegGeometry& geometry, double sample_rate,
                           const SignalGuardConfig& guard)
    : geometry_(geometry),
      guard_(guard),
      has_hip_(geometry.has_hip()),
      rate_(sample_rate),
      gain_(exact_low_pass_gain(time_constant, sample_rate)),
      alignment_gain_(exact_low_pass_gain(alignment, sample_rate)),
      contradiction_gain_(exact_low_pass_gain(contradiction, sample_rate)),
      white_(gain_ / (2.0 - gain_)),
      white_of_change_(2.0 * gain_ * white_ * square(sample_rate)),
      weight_(gravity * geometry.robot_mass),
      torque_noise_(NoiseEstimate<2>(0.01, 10.0, noise_gain, warm_up * sample_rate)),
      servo_noise_(torque_noise_),
      velocity_noise_(0.001, 10.0, noise_gain, warm_up * sample_rate),
      acceleration_noise_(0.05, 30.0, noise_gain, warm_up * sample_rate) {
  const LegGeometry& g = geometry_;
  const double upper_length = has_hip_ ? g.upper_length : 0.0;
  const double upper_centre = g.upper_centre * upper_length;
  const double lower_centre = g.lower_centre * g.lower_length;
  const double below_knee = g.lower_mass + g.wheel_mass;
  leg_mass_ = below_knee + (has_hip_ ? g.upper_mass : 0.0);
  upper_mass_ = g.upper_mass * g.upper_centre + below_knee;
  lower_mass_ = g.lower_mass * g.lower_centre + g.wheel_mass;
  upper_inertia_ =
      g.upper_inertia + g.upper_mass * square(upper_centre) + below_knee * square(upper_length);
  lower_inertia_ =
      g.lower_inertia + g.lower_mass * square(lower_centre) + g.wheel_mass * square(g.lower_length);
  model_variance_ = square(model_error * weight_);
  const double friction = std::max(g.hip_friction, g.knee_friction);
  torque_variance_ = square(torque_error * weight_ * (upper_length + g.lower_length)) +
                     square(friction) / 3.0;  // uniform within ± the friction
  servo_variance_ = square(servo_share) * torque_variance_;
  for (const double sigma : acceleration_noise_.levels()) {
    acceleration_gain_.push_back(exact_low_pass_gain(
        time_constant + longer_with_noise * std::min(sigma, most_acceleration_noise), sample_rate));
  }
}

void DynamicLoads::JointNoise::update(const std::array<LegTorques, 2>& torque) noexcept {
  hip.update({torque[0].hip, torque[1].hip});
  knee.update({torque[0].knee, torque[1].knee});
  wheel.update({torque[0].wheel, torque[1].wheel});
}

void DynamicLoads::JointNoise::reset() noexcept {
  for (NoiseEstimate<2>* of : {&hip, &knee, &wheel}) of->reset();
}

void DynamicLoads::JointNoise::reset_signals() noexcept {
  for (NoiseEstimate<2>* of : {&hip, &knee, &wheel}) of->reset_signals();
}

void DynamicLoads::reset() noexcept {
  restart();
  torque_noise_.reset();
  servo_noise_.reset();
  velocity_noise_.reset();
  acceleration_noise_.reset();
}

void DynamicLoads::restart() noexcept {
  torso_ = {};
  leg_ = {};
  balance_ = {};
  torque_noise_.reset_signals();
  servo_noise_.reset_signals();
  velocity_noise_.reset_signals();
  acceleration_noise_.reset_signals();
}

DynamicLoads::Loads DynamicLoads::known(const Loads& loads) const noexcept {
  Loads known;
  for (std::size_t side = 0; side < 2; ++side) {
    if (loads[side].deviation <= largest_share * weight_) known[side] = loads[side];
  }
  return known;
}

DynamicLoads::Loads DynamicLoads::update(const Signals& signals, bool has_acceleration) noexcept {
  const bool has_imu = has_acceleration &&
                       std::isfinite(signals.time + signals.vertical_acceleration) &&
                       signals.linear_acceleration.allFinite() && signals.up.allFinite();
  std::array<bool, 2> has_leg{};
  std::array<LegTorques, 2> by_servos{};
  std::array<LegSignals, 2> legs = signals.leg;
  for (std::size_t side = 0; side < 2; ++side) {
    LegSignals& leg = legs[side];
    if (!has_hip_) leg.hip = {};
    has_leg[side] = is_torque(leg.hip.torque, guard_) && is_torque(leg.knee.torque, guard_) &&
                    is_torque(leg.wheel.torque, guard_) &&
                    std::isfinite(leg.hip.position + leg.knee.position) &&
                    std::isfinite(leg.hip.velocity + leg.knee.velocity + leg.wheel.velocity);
    by_servos[side] = servo_torques(leg, signals.target[side]);
  }
  has_targets_ = by_servos[0].is_known() && by_servos[1].is_known();
  std::array<LegLoad, 2> by_leg;
  if (has_imu) {
    update_torso(signals);
    for (std::size_t side = 0; side < 2; ++side) {
      if (!has_leg[side]) continue;
      const double elapsed = signals.time - leg_[side].time;
      if (!(elapsed >= 0.0 && elapsed <= guard_.maximum_gap)) leg_[side] = {};
      leg_[side].time = signals.time;
      by_leg[side] = update_leg(side, legs[side], by_servos[side]);
    }
  }
  const Loads loads = balanced(by_leg);
  observe_noise(signals, has_imu, has_leg, by_servos);
  return loads;
}

void DynamicLoads::update_torso(const Signals& signals) noexcept {
  const double elapsed = signals.time - torso_time_;
  if (!(elapsed >= 0.0 && elapsed <= guard_.maximum_gap)) torso_ = {};
  torso_time_ = signals.time;
  const auto in_torso = [](const Eigen::Vector3d& v) -> Eigen::Vector3d {
    return {-v.x(), v.y(), -v.z()};
  };
  // The vertical part is that of the vertical acceleration, so that it alone is enough.
  const Eigen::Vector3d& linear = signals.linear_acceleration;
  const double vertical = gravity + signals.vertical_acceleration - signals.up.dot(linear);
  torso_.aligned.update(in_torso(linear + vertical * signals.up), alignment_gain_);
  torso_.specific_force.update(torso_.aligned.value,
                               acceleration_gain_[acceleration_noise_.level()]);
  // Rotation is a small part: without a gyroscope, the torso is taken not to turn.
  const bool has_turn = signals.angular_velocity.allFinite();
  const Eigen::Vector3d turn = has_turn ? signals.angular_velocity : Eigen::Vector3d(0, 0, 0);
  torso_.turn.update(in_torso(turn), gain_);
  torso_.turn_acceleration = rate_ * torso_.turn.change;
  torso_.up = {-signals.up.x(), -signals.up.z()};
}

DynamicLoads::LegTorques DynamicLoads::servo_torques(const LegSignals& leg,
                                                     const LegTargets& target) const noexcept {
  const auto limited = [](double torque, double limit) {  // NaN stays
    return torque > limit ? limit : torque < -limit ? -limit : torque;
  };
  const double hip = has_hip_ ? servo_torque(leg.hip, target.hip, guard_) : 0.0;
  // Wheels are driven by velocity: a position that is not given has no part in their law.
  JointTarget of_wheel = target.wheel;
  if (!std::isfinite(of_wheel.position)) of_wheel.position = leg.wheel.position;
  const double wheel = servo_torque(leg.wheel, of_wheel);
  return {limited(hip, geometry_.hip_torque_limit),
          limited(servo_torque(leg.knee, target.knee, guard_), geometry_.knee_torque_limit),
          std::isfinite(wheel) ? limited(wheel, geometry_.wheel_torque_limit) : leg.wheel.torque};
}

void DynamicLoads::update_moments(Moments& moments, const LegTorques& torque, const LegSignals& leg,
                                  double sign) const noexcept {
  const double hip = torque.hip - geometry_.hip_viscous * leg.hip.velocity;
  const double knee = torque.knee - geometry_.knee_viscous * leg.knee.velocity;
  const double wheel = torque.wheel - geometry_.wheel_viscous * leg.wheel.velocity;
  moments.aligned.update(sign * Eigen::Vector2d(knee - hip, -knee - wheel), alignment_gain_);
  moments.value.update(moments.aligned.value, gain_);
}

/// A leg's links in its plane, forward and upward (m).
struct DynamicLoads::Links {
  Eigen::Vector2d upper;  ///< L₁ e₁; none without a hip
  Eigen::Vector2d lower;  ///< L₂ e₂
  double determinant;
};

/// F_z = upper (h₁ − τ₁ + τ₂) + lower (h₂ − τ₂ − τ_w) + offset.
struct DynamicLoads::Levers {
  double upper = 0.0;            ///< 1/m
  double lower = 0.0;            ///< 1/m
  double offset = 0.0;           ///< N
  double offset_variance = 0.0;  ///< N²
  Eigen::Vector2d by_force;      ///< F_z per specific force of the hip (kg)
};

DynamicLoads::Levers DynamicLoads::levers(const Links& links,
                                          const Eigen::Vector2d& required) const noexcept {
  const Eigen::Vector2d& up = torso_.up;
  Levers levers;
  if (has_hip_) {
    const double per_area = 1.0 / (links.determinant + std::copysign(straight, links.determinant));
    levers.upper = (links.lower.y() * up.x() - links.lower.x() * up.y()) * per_area;
    levers.lower = (links.upper.x() * up.y() - links.upper.y() * up.x()) * per_area;
    levers.by_force =
        levers.upper * upper_mass_ * links.upper + levers.lower * lower_mass_ * links.lower;
    return levers;
  }
  // One equation for two components: both legs together take the forward one, in unknown shares.
  const Eigen::Vector2d forward(up.y(), -up.x());
  const double along = links.lower.dot(up);
  levers.lower = 1.0 / (along + std::copysign(straight, along));
  const double slope = levers.lower * links.lower.dot(forward);
  const Eigen::Vector2d carried = slope * 0.5 * geometry_.robot_mass * forward;
  levers.offset = -slope * forward.dot(required);
  levers.offset_variance = square(forward_error * weight_ * slope) + square(levers.offset);
  levers.by_force = levers.lower * lower_mass_ * links.lower - carried;
  return levers;
}

DynamicLoads::LegLoad DynamicLoads::update_leg(std::size_t side, const LegSignals& signals,
                                               const LegTorques& by_servos) noexcept {
  Leg& leg = leg_[side];
  const FootJacobian foot = foot_jacobian(geometry_, signals, side == 1);
  const double sign = side == 0 ? 1.0 : -1.0;
  const double upper_rate = sign * signals.hip.velocity;
  leg.rate.update(
      {upper_rate, upper_rate + sign * signals.knee.velocity, sign * signals.wheel.velocity},
      gain_);
  update_moments(leg.by_torques, {signals.hip.torque, signals.knee.torque, signals.wheel.torque},
                 signals, sign);

  // The hip's specific force (m/s²): s + ω̇ × r + ω × (ω × r).
  const Eigen::Vector3d& turn = torso_.turn.value;
  const Eigen::Vector3d arm(geometry_.hip_forward, sign * geometry_.leg_sideways,
                            geometry_.hip_upward);
  const Eigen::Vector3d of_hip = torso_.specific_force.value + torso_.turn_acceleration.cross(arm) +
                                 turn.cross(turn.cross(arm));
  const Eigen::Vector2d force(of_hip.x(), of_hip.z());

  // h₁ and h₂. The links turn about −y, with the torso.
  Links links = {{foot.upper_x, foot.upper_z}, {foot.lower_x, foot.lower_z}, foot.determinant()};
  if (!has_hip_) links.upper.setZero();
  const Eigen::Vector3d acceleration = rate_ * leg.rate.change;
  const double of_knee = acceleration[1] - acceleration[0];
  const double upper_turn = acceleration[0] - torso_.turn_acceleration.y();
  const double lower_turn = acceleration[1] - torso_.turn_acceleration.y();
  const double coupling = lower_mass_ * links.upper.dot(links.lower);
  const double centrifugal = has_hip_ ? lower_mass_ * links.determinant : 0.0;
  const double of_upper =
      upper_mass_ * links.upper.dot(force) + upper_inertia_ * upper_turn + coupling * lower_turn -
      centrifugal * square(leg.rate.value[1] - turn.y()) +
      geometry_.hip_armature * acceleration[0] - geometry_.knee_armature * of_knee;
  const double of_lower =
      lower_mass_ * links.lower.dot(force) + lower_inertia_ * lower_turn + coupling * upper_turn +
      centrifugal * square(leg.rate.value[0] - turn.y()) + geometry_.knee_armature * of_knee +
      geometry_.wheel_armature * acceleration[2];

  // Of the leg's masses relative to the hip: their links turn and swing.
  const auto swung = [](const Eigen::Vector2d& link, double link_turn, double link_rate) {
    const Eigen::Vector2d inward(-link.y(), link.x());
    return Eigen::Vector2d(link_turn * link + square(link_rate) * inward);
  };
  const Eigen::Vector2d required =
      0.5 * geometry_.robot_mass * force +
      upper_mass_ * swung(links.upper, upper_turn, leg.rate.value[0] - turn.y()) +
      lower_mass_ * swung(links.lower, lower_turn, leg.rate.value[1] - turn.y());

  const Levers by = levers(links, required);
  const auto solved = [&](const Moments& moments) {
    return by.upper * (of_upper + moments.value.value[0]) +
           by.lower * (of_lower + moments.value.value[1]) + by.offset;
  };
  const double by_hip = by.upper * (upper_inertia_ + coupling + geometry_.hip_armature) +
                        by.lower * (lower_inertia_ + coupling);
  const double by_knee = by.upper * (coupling - geometry_.knee_armature) +
                         by.lower * (lower_inertia_ + geometry_.knee_armature);
  const double by_up = by.by_force.dot(torso_.up);
  const double lift = links.upper.y() * upper_turn + links.lower.y() * lower_turn;  // of the axle
  const double common =
      acceleration_variance() * (by.by_force.squaredNorm() - square(by_up)) +
      white_of_change_ * square(velocity_noise_.sigma()) * (square(by_hip) + square(by_knee)) +
      square(dynamic_error * leg_mass_ * lift) + model_variance_ + by.offset_variance;
  const auto of_joints = [&](const JointNoise& noise, double systematic) {
    return square(by.upper) * (white_ * square(noise.hip.sigma()) + systematic) +
           square(by.upper - by.lower) * (white_ * square(noise.knee.sigma()) + systematic) +
           square(by.lower) * (white_ * square(noise.wheel.sigma()) + systematic);
  };
  const double variance = of_joints(torque_noise_, torque_variance_) + common;
  const auto load = [&](double vertical, double own) {
    return LegLoad{vertical, own + square(scale_error * vertical), by_up, required.dot(torso_.up)};
  };
  if (!by_servos.is_known()) {
    leg.by_servos = {};
    return load(solved(leg.by_torques), variance);
  }
  update_moments(leg.by_servos, by_servos, signals, sign);
  const double servo_variance = of_joints(servo_noise_, servo_variance_) + common;
  const double share = servo_variance / (variance + servo_variance);
  return load(share * solved(leg.by_torques) + (1.0 - share) * solved(leg.by_servos),
              std::min(variance, servo_variance));
}

double DynamicLoads::acceleration_variance() const noexcept {
  const double gain = acceleration_gain_[acceleration_noise_.level()];
  return gain / (2.0 - gain) * square(acceleration_noise_.sigma());
}

DynamicLoads::Loads DynamicLoads::balanced(const std::array<LegLoad, 2>& by_leg) noexcept {
  // Unknown: both loads and the vertical accelerometer's error, which each leg's load contains.
  Eigen::Vector3d state(0, 0, 0);
  Eigen::Vector3d of_error(0, 0, -1);
  Eigen::Vector3d variance(0, 0, 0);
  for (Eigen::Index side = 0; side < 2; ++side) {
    const LegLoad& leg = by_leg[static_cast<std::size_t>(side)];
    // A straight leg bears any load.
    const bool is_bent = leg.variance < square(weight_);
    state[side] = is_bent ? leg.force : 0.5 * weight_;
    of_error[side] = is_bent ? leg.by_acceleration : 0.0;
    variance[side] = std::min(leg.variance, square(weight_));
  }
  Eigen::Matrix3d covariance = variance.asDiagonal();
  if (std::isfinite(state.sum())) {
    const double mass = geometry_.robot_mass;
    const auto low_passed = [](LowPass<1>& of, double input, double gain) {
      of.update(LowPass<1>::Values(input), gain);
      return of.value[0];
    };
    const double sum = by_leg[0].required + by_leg[1].required;
    const double difference = state[0] + state[1] - sum;
    const double lasting = low_passed(balance_.lasting, difference, contradiction_gain_);
    const double passing =
        low_passed(balance_.passing, square(difference - lasting), contradiction_gain_);
    const double by_torques = variance.sum();
    covariance += std::max(acceleration_variance(),
                           (passing - by_torques) / square(mass - of_error[0] - of_error[1])) *
                  of_error * of_error.transpose();
    const auto observe = [&](const Eigen::Vector3d& of_state, double value, double its_variance) {
      const Eigen::Vector3d shared = covariance * of_state;
      const Eigen::Vector3d gain = shared / (of_state.dot(shared) + its_variance);
      state += gain * (value - of_state.dot(state));
      covariance -= gain * shared.transpose();
    };
    observe({1, 1, mass}, sum,
            square(sum_error * weight_) + square(carried_share * sum) +
                carried_variance * std::max(0.0, square(lasting) - by_torques));
    // Neither load is negative: they differ by no more than their sum.
    const double both = std::max(0.0, state[0] + state[1]);
    observe({1, -1, 0}, 0.0, square(sum_error * weight_) + 2.0 * square(both));
  } else {
    balance_ = {};
    covariance += acceleration_variance() * of_error * of_error.transpose();
  }
  const auto load = [&](Eigen::Index side) {
    return std::isfinite(state[side])
               ? WheelLoad{state[side], std::sqrt(std::max(0.0, covariance(side, side)))}
               : WheelLoad{};
  };
  return {load(0), load(1)};
}

void DynamicLoads::observe_noise(const Signals& signals, bool has_imu,
                                 const std::array<bool, 2>& has_leg,
                                 const std::array<LegTorques, 2>& by_servos) noexcept {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  std::array<LegTorques, 2> by_torques;
  std::array<LegTorques, 2> laws;
  std::array<double, 4> velocity{nan, nan, nan, nan};
  by_torques.fill({nan, nan, nan});
  laws = by_torques;
  for (std::size_t side = 0; side < 2; ++side) {
    if (!has_leg[side]) continue;
    const LegSignals& leg = signals.leg[side];
    by_torques[side] = {has_hip_ ? leg.hip.torque : nan, leg.knee.torque, leg.wheel.torque};
    laws[side] = by_servos[side];
    if (!has_hip_) laws[side].hip = nan;
    velocity[2 * side] = has_hip_ ? leg.hip.velocity : nan;
    velocity[2 * side + 1] = leg.knee.velocity;
  }
  torque_noise_.update(by_torques);
  servo_noise_.update(laws);
  velocity_noise_.update(velocity);
  acceleration_noise_.update({has_imu ? signals.vertical_acceleration : std::nan("")});
}

}  // namespace touchdown
