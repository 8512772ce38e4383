#pragma once

#include <array>

#include <Eigen/Core>

#include "core/error.hpp"
#include "estimator/odometry/lie.hpp"
#include "estimator/odometry/wheeled_leg.hpp"

namespace touchdown::odometry {

/// The measurements of one time step.
struct OdometrySample {
  double time = 0.0;  ///< s; only differences count
  /// In the IMU frame: angular velocity at this time (rad/s), and specific force, gravity included,
  /// averaged since the last step (m/s²).
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();
  Eigen::Vector3d specific_force = Eigen::Vector3d::Zero();
  std::array<LegJoints, 2> leg = {};             ///< left, right
  std::array<double, 2> p_contact = {0.5, 0.5};  ///< probability of ground contact
};

/// White noise is given as a density: the standard deviation of the mean over one second.
struct OdometryConfig {
  WheeledBiped robot = upkie();
  double gravity = 9.81;  ///< m/s²

  double gyroscope_noise = 2e-4;       ///< rad/s/√Hz
  double gyroscope_walk = 1e-4;        ///< of the bias: rad/s after a second
  double accelerometer_noise = 3e-3;   ///< m/s²/√Hz
  double accelerometer_share = 2e-3;   ///< added per m/s² of deviation from 1 g
  double accelerometer_walk = 1e-3;    ///< of the bias: m/s² after a second
  double accelerometer_range = 58.86;  ///< an axis near this value is saturated (m/s²)
  double saturated_noise = 10.0;       ///< of a saturated axis (m/s²/√Hz)

  /// Velocity of the contact point of a wheel in certain contact (m/s/√Hz). Steady slip is a few
  /// mm/s; over edges and after landings it is some dm/s for tens of milliseconds.
  double contact_noise = 0.025;
  double doubt = 0.3;   ///< added at P(contact) = 0.5; grows below (m/s/√Hz)
  double slope = 6e-3;  ///< of the unknown ground, as a gradient (1/√Hz)

  double initial_tilt = 0.02;               ///< rad
  double initial_velocity = 0.05;           ///< m/s
  double initial_gyroscope_bias = 3e-3;     ///< rad/s
  double initial_accelerometer_bias = 0.2;  ///< m/s²
};

/// The state in the horizontal plane.
struct PlanarState {
  Eigen::Vector2d position;  ///< m
  Eigen::Vector2d velocity;  ///< m/s
  double heading = 0.0;      ///< rad, positive to the left
};

/// The estimate: pose and velocity of the IMU, with the axes of the base (x forward, y left, z up).
/// The origin and the heading of the world are those of the start.
struct OdometryState {
  using Covariance = Eigen::Matrix<double, 15, 15>;

  ExtendedPose pose;
  Eigen::Vector3d gyroscope_bias = Eigen::Vector3d::Zero();      ///< in the axes of the base
  Eigen::Vector3d accelerometer_bias = Eigen::Vector3d::Zero();  ///< in the axes of the base
  /// Covariance of (ξ, both biases), with estimate · truth⁻¹ = exp(ξ): errors in the world frame.
  Covariance covariance = Covariance::Zero();

  [[nodiscard]] PlanarState planar() const noexcept;
};

/// Contact-aided odometry of a wheeled biped from IMU, encoders and the contact probability of each
/// wheel. It is a right-invariant extended Kalman filter on SE₂(3) with the biases of the IMU
/// (Hartley et al. 2020). The measurement is that the contact point of a wheel is at rest.
/// P(contact) weighs its noise continuously (docs/explanation/odometry.md).
///
/// Heading and position are not observable and drift; the other states converge. `update` never
/// throws, allocates or locks. It ignores values that are not finite.
class ContactOdometry {
 public:
  /// Throws `InputError` for an invalid length, noise or gravity.
  explicit ContactOdometry(const OdometryConfig& config = {});

  /// Restarts. The next sample, taken at rest, defines the origin; its accelerometer gives the
  /// tilt.
  void reset() noexcept;
  /// Restarts from a given state.
  void reset(const OdometryState& start) noexcept;

  const OdometryState& update(const OdometrySample& sample) noexcept;
  [[nodiscard]] const OdometryState& state() const noexcept { return state_; }

 private:
  void update_imu(const OdometrySample& sample) noexcept;
  void level() noexcept;
  void propagate(double step) noexcept;
  void add_noise(double step, const Eigen::Matrix3d& to_world,
                 const Eigen::Vector3d& before) noexcept;
  [[nodiscard]] Eigen::Vector3d accelerometer_variance(double step) const noexcept;
  void correct(const WheeledLeg& leg, const LegJoints& joints, double p_contact,
               double step) noexcept;

  OdometryConfig config_;
  OdometryState state_;
  bool is_placed_ = false;     ///< whether the pose is initialised
  bool has_begun_ = false;     ///< whether there was a sample
  double time_ = 0.0;          ///< of the last sample
  Eigen::Vector3d rate_;       ///< last valid angular velocity, in the axes of the base
  Eigen::Vector3d last_rate_;  ///< the previous one
  Eigen::Vector3d force_;      ///< last valid specific force, in the axes of the base
};

}  // namespace touchdown::odometry
