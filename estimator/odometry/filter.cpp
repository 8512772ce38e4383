#include "estimator/odometry/filter.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace touchdown::odometry {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Covariance = OdometryState::Covariance;

// Index of the first element of each part of the error vector.
constexpr int rotation = 0, velocity = 3, position = 6, gyroscope = 9, accelerometer = 12;

const Vector3d up = Vector3d::UnitZ();

/// Whether a measurement is plausible: finite and at most `largest`.
bool is_valid(const Vector3d& value, double largest) noexcept {
  return value.cwiseAbs().maxCoeff() <= largest && value.allFinite();
}

bool is_valid(const LegJoints& joints) noexcept {
  constexpr double largest = 1e5;  // rad, rad/s
  const auto is_sane = [](double x) { return std::abs(x) <= largest; };
  return std::all_of(joints.position.begin(), joints.position.end(), is_sane) &&
         std::all_of(joints.velocity.begin(), joints.velocity.end(), is_sane);
}

/// M·P·Mᵀ, symmetric to the last bit.
template <typename Map, typename Middle>
Covariance between(const Map& map, const Middle& middle) noexcept {
  const Map half_way = map.lazyProduct(middle);
  const Covariance whole = half_way.lazyProduct(map.transpose());
  return 0.5 * (whole + whole.transpose());
}

auto diagonal(const Vector3d& variances) noexcept { return Matrix3d(variances.asDiagonal()); }

}  // namespace

PlanarState OdometryState::planar() const noexcept {
  return {pose.position.head<2>(), pose.velocity.head<2>(),
          std::atan2(pose.rotation(1, 0), pose.rotation(0, 0))};
}

ContactOdometry::ContactOdometry(const OdometryConfig& config) : config_(config) {
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw InputError(std::string("odometry: expected ") + what);
  };
  require(config.robot.wheel_radius > 0.0, "wheel_radius > 0");
  require(config.gravity > 0.0, "gravity > 0");
  require(config.contact_noise > 0.0, "contact_noise > 0");
  for (const double noise :
       {config.gyroscope_noise, config.gyroscope_walk, config.accelerometer_noise,
        config.accelerometer_share, config.accelerometer_walk, config.accelerometer_range,
        config.saturated_noise, config.doubt, config.slope, config.initial_tilt,
        config.initial_velocity, config.initial_gyroscope_bias,
        config.initial_accelerometer_bias}) {
    require(noise >= 0.0, "no negative noise");
  }
  reset();
}

void ContactOdometry::reset() noexcept {
  OdometryState start;
  const auto variances = [&](int at, const Vector3d& deviation) {
    start.covariance.diagonal().segment<3>(at) = deviation.cwiseAbs2();
  };
  variances(rotation, Vector3d(config_.initial_tilt, config_.initial_tilt, 0.0));
  variances(velocity, Vector3d::Constant(config_.initial_velocity));
  variances(gyroscope, Vector3d::Constant(config_.initial_gyroscope_bias));
  variances(accelerometer, Vector3d::Constant(config_.initial_accelerometer_bias));
  reset(start);
  is_placed_ = false;
}

void ContactOdometry::reset(const OdometryState& start) noexcept {
  state_ = start;
  is_placed_ = true;
  has_begun_ = false;
  rate_ = last_rate_ = Vector3d::Zero();
  force_ = config_.gravity * up;
}

void ContactOdometry::update_imu(const OdometrySample& sample) noexcept {
  constexpr double fastest = 1e3;  // rad/s
  constexpr double hardest = 1e5;  // m/s²
  last_rate_ = rate_;
  if (is_valid(sample.angular_velocity, fastest)) {
    rate_ = config_.robot.imu_in_base * sample.angular_velocity;
  }
  if (is_valid(sample.specific_force, hardest)) {
    force_ = config_.robot.imu_in_base * sample.specific_force;
  }
}

void ContactOdometry::level() noexcept {
  is_placed_ = true;
  if (!(force_.norm() > 0.0)) return;
  // The world's axes in the frame of the base, with a heading of zero. With x vertical, the heading
  // is arbitrary.
  const Vector3d z = force_.normalized();
  const Vector3d sideways = z.cross(Vector3d::UnitX());
  const Vector3d y = sideways.norm() > 1e-6 ? Vector3d(sideways.normalized()) : Vector3d::UnitY();
  state_.pose.rotation << y.cross(z).transpose(), y.transpose(), z.transpose();
}

/// Variance of the accelerometer's white noise over a second, along its own axes. It is large for a
/// saturated axis and after a gap in the samples.
Vector3d ContactOdometry::accelerometer_variance(double step) const noexcept {
  constexpr double longest = 0.005;  // s
  const double shaken = config_.accelerometer_share * (force_.norm() - config_.gravity);
  const Vector3d reported = config_.robot.imu_in_base.transpose() * force_;
  Vector3d variance;
  for (int axis = 0; axis < 3; ++axis) {
    const bool is_saturated = std::abs(reported[axis]) >= 0.98 * config_.accelerometer_range;
    const double saturated = is_saturated || step > longest ? config_.saturated_noise : 0.0;
    variance[axis] = config_.accelerometer_noise * config_.accelerometer_noise + shaken * shaken +
                     saturated * saturated;
  }
  return variance;
}

void ContactOdometry::propagate(double step) noexcept {
  ExtendedPose& pose = state_.pose;
  const Vector3d gravity = -config_.gravity * up;
  const Vector3d before = pose.velocity;
  const Vector3d turn = 0.5 * (rate_ + last_rate_) - state_.gyroscope_bias;
  const Matrix3d middle = pose.rotation * exp_so3(0.5 * step * turn);
  pose.rotation =
      Eigen::Quaterniond(pose.rotation * exp_so3(step * turn)).normalized().toRotationMatrix();
  const Vector3d force = force_ - state_.accelerometer_bias;
  pose.velocity += step * (pose.rotation * force + gravity);
  pose.position += 0.5 * step * (before + pose.velocity);

  // Φ = 1 + A·T + ½ (A·T)² of dξ/dt = A ξ. Without the biases it depends on gravity alone.
  const Matrix3d fall = hat(gravity);
  const Matrix3d of_velocity = hat(before) * middle;
  const Matrix3d of_position = hat(pose.position) * middle;
  Covariance phi = Covariance::Identity();
  const auto set = [&](int row, int column, const Matrix3d& block) {
    phi.block<3, 3>(row, column) = block;
  };
  const double half = 0.5 * step * step;
  set(rotation, gyroscope, -step * middle);
  set(velocity, rotation, step * fall);
  set(velocity, gyroscope, -step * of_velocity - half * fall * middle);
  set(velocity, accelerometer, -step * middle);
  set(position, rotation, half * fall);
  set(position, velocity, step * Matrix3d::Identity());
  set(position, gyroscope, -step * of_position - half * of_velocity);
  set(position, accelerometer, -half * middle);
  state_.covariance = between(phi, state_.covariance);

  add_noise(step, middle, before);
}

/// The white noise of both sensors enters in the same way as their biases.
void ContactOdometry::add_noise(double step, const Matrix3d& to_world,
                                const Vector3d& before) noexcept {
  const Matrix3d imu_to_world = to_world * config_.robot.imu_in_base;
  Eigen::Matrix<double, 15, 6> of_noise = Eigen::Matrix<double, 15, 6>::Zero();
  of_noise.block<3, 3>(rotation, 0).setIdentity();
  of_noise.block<3, 3>(velocity, 0) = hat(before);
  of_noise.block<3, 3>(position, 0) = hat(state_.pose.position);
  of_noise.block<3, 3>(velocity, 3).setIdentity();
  of_noise.block<3, 3>(position, 3).diagonal().setConstant(0.5 * step);
  Eigen::Matrix<double, 6, 6> noise = Eigen::Matrix<double, 6, 6>::Zero();
  noise.diagonal().head<3>().setConstant(step * config_.gyroscope_noise * config_.gyroscope_noise);
  noise.bottomRightCorner<3, 3>() =
      step * imu_to_world * diagonal(accelerometer_variance(step)) * imu_to_world.transpose();
  state_.covariance += between(of_noise, noise);
  const auto walk = [&](int at, double deviation) {
    state_.covariance.diagonal().segment<3>(at).array() += step * deviation * deviation;
  };
  walk(gyroscope, config_.gyroscope_walk);
  walk(accelerometer, config_.accelerometer_walk);
}

void ContactOdometry::correct(const WheeledLeg& leg, const LegJoints& joints, double p_contact,
                              double step) noexcept {
  constexpr double least = 1e-6;
  if (!(p_contact > least) || !is_valid(joints)) return;
  const double p = std::min(p_contact, 1.0);
  const ExtendedPose& pose = state_.pose;
  const double radius = config_.robot.wheel_radius;
  const WheelMotion wheel = motion_of(leg, joints);
  const Vector3d rate = rate_ - state_.gyroscope_bias;

  // The velocity of the IMU for which the lowest point of the wheel is at rest.
  const Vector3d spin = pose.rotation * (rate + wheel.spin * Vector3d::UnitY());
  const Vector3d rolling = radius * spin.cross(up);
  const Vector3d measured = rolling - pose.rotation * (rate.cross(wheel.centre) + wheel.velocity);
  const Vector3d innovation = measured - pose.velocity;

  // innovation = H ξ + noise. H depends on rotation, velocity and the gyroscope's bias only.
  const Matrix3d of_rotation = radius * hat(spin) * hat(up);
  const Vector3d point = wheel.centre - radius * (pose.rotation.transpose() * up);
  const Matrix3d of_bias = -pose.rotation * hat(point);
  const double doubt = config_.doubt * config_.doubt * (1.0 - p) / p;
  const double level = (config_.contact_noise * config_.contact_noise + doubt) / step;
  const double steep = config_.slope * config_.slope * rolling.squaredNorm() / step;
  const Matrix3d noise = diagonal({level, level, level + steep});

  Eigen::Matrix<double, 3, 15> h = Eigen::Matrix<double, 3, 15>::Zero();
  h.middleCols<3>(rotation) = of_rotation;
  h.middleCols<3>(velocity) = -Matrix3d::Identity();
  h.middleCols<3>(gyroscope) = of_bias;
  const Eigen::Matrix<double, 15, 3> shared = state_.covariance.lazyProduct(h.transpose());
  const Matrix3d expected = h.lazyProduct(shared) + noise;
  const Eigen::Matrix<double, 15, 3> gain = shared * expected.inverse();
  const Eigen::Matrix<double, 15, 1> error = gain * innovation;
  if (!error.allFinite()) return;
  state_.pose = exp_se23(-error.head<9>()) * state_.pose;
  state_.gyroscope_bias -= error.segment<3>(gyroscope);
  state_.accelerometer_bias -= error.segment<3>(accelerometer);
  const Covariance less = gain.lazyProduct(shared.transpose());
  state_.covariance -= 0.5 * (less + less.transpose());
}

const OdometryState& ContactOdometry::update(const OdometrySample& sample) noexcept {
  if (!std::isfinite(sample.time)) return state_;
  update_imu(sample);
  if (!is_placed_) level();
  const double step = sample.time - time_;
  time_ = sample.time;
  if (!has_begun_) {
    has_begun_ = true;
    last_rate_ = rate_;
    return state_;
  }
  if (!(step > 0.0)) return state_;
  propagate(step);
  for (std::size_t wheel = 0; wheel < 2; ++wheel) {
    correct(config_.robot.leg[wheel], sample.leg[wheel], sample.p_contact[wheel], step);
  }
  return state_;
}

}  // namespace touchdown::odometry
