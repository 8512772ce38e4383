#pragma once

#include <array>

#include <Eigen/Core>

#include "odometry/lie.hpp"
#include "odometry/wheeled_leg.hpp"

namespace touchdown::odometry {

/// What is measured at one time step.
struct OdometrySample {
  double time = 0.0;  ///< s; only differences count
  /// Of the IMU, in its own frame: rad/s at this time, and what the accelerometer reports, gravity
  /// included, as a mean since the last step (m/s²).
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();
  Eigen::Vector3d specific_force = Eigen::Vector3d::Zero();
  std::array<LegJoints, 2> leg = {};             ///< left, right
  std::array<double, 2> p_contact = {0.5, 0.5};  ///< that the wheel touches the ground
};

/// White noise is given as a density: the standard deviation of its mean over one second.
struct OdometryConfig {
  WheeledBiped robot = upkie();
  double gravity = 9.81;  ///< m/s²

  double gyroscope_noise = 2e-4;       ///< rad/s/√Hz
  double gyroscope_walk = 1e-4;        ///< of its bias: rad/s after a second
  double accelerometer_noise = 3e-3;   ///< m/s²/√Hz
  double accelerometer_share = 2e-3;   ///< likewise, per m/s² that is measured besides 1 g
  double accelerometer_walk = 1e-3;    ///< of its bias: m/s² after a second
  double accelerometer_range = 58.86;  ///< an axis that reports nearly so much (m/s²) …
  double saturated_noise = 10.0;       ///< … is as good as this (m/s²/√Hz)

  /// Velocity of the point of a wheel that surely touches (m/s/√Hz). Steadily it slips by a few
  /// millimetres a second; over edges and after landings, by decimetres for tens of milliseconds.
  double contact_noise = 0.025;
  double doubt = 0.3;   ///< that and more where contact is as likely as not (m/s/√Hz)
  double slope = 6e-3;  ///< steepness of the ground, of which nothing is known (1/√Hz)

  double initial_tilt = 0.02;               ///< rad
  double initial_velocity = 0.05;           ///< m/s
  double initial_gyroscope_bias = 3e-3;     ///< rad/s
  double initial_accelerometer_bias = 0.2;  ///< m/s²
};

/// The robot from above.
struct PlanarState {
  Eigen::Vector2d position;  ///< m
  Eigen::Vector2d velocity;  ///< m/s
  double heading = 0.0;      ///< rad, positive to the left
};

/// What is believed: the IMU's place and motion with the axes of the base (x forward, y left, z
/// up), in a world whose origin and heading are those of the start.
struct OdometryState {
  using Covariance = Eigen::Matrix<double, 15, 15>;

  ExtendedPose pose;
  Eigen::Vector3d gyroscope_bias = Eigen::Vector3d::Zero();      ///< in the axes of the base
  Eigen::Vector3d accelerometer_bias = Eigen::Vector3d::Zero();  ///< likewise
  /// Of (ξ, both biases), with estimate · truth⁻¹ = exp(ξ): errors as the world sees them.
  Covariance covariance = Covariance::Zero();

  [[nodiscard]] PlanarState planar() const noexcept;
};

/// Where a wheeled biped is and how fast, by IMU, encoders and the probability that each wheel
/// touches the ground: a right-invariant extended Kalman filter on SE₂(3) with the biases of the
/// IMU (Hartley et al. 2020), whose measurement is that the point of a touching wheel stands still.
/// How sure that is is weighed by P(contact), not switched. docs/odometry.md derives it.
///
/// Heading and place are not observable and drift; what else there is converges. `update` never
/// throws, allocates or locks; what is not a number is not used.
class ContactOdometry {
 public:
  /// Throws InputError for a length, a noise or gravity that makes no sense.
  explicit ContactOdometry(const OdometryConfig& config = {});

  /// Forgets everything: the next sample, at rest, is the origin, level as its accelerometer says.
  void reset() noexcept;
  /// Likewise, but with this belief.
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
  bool is_placed_ = false;  ///< it knows a pose, which may be a given one
  bool has_begun_ = false;  ///< there was a sample
  double time_ = 0.0;       ///< of the last sample
  Eigen::Vector3d rate_;    ///< of the gyroscope, in the axes of the base; the last that was heard
  Eigen::Vector3d last_rate_;  ///< the one before
  Eigen::Vector3d force_;      ///< of the accelerometer, likewise
};

}  // namespace touchdown::odometry
