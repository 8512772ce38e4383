#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "estimator/contact_estimator.hpp"
#include "estimator/force/leg_geometry.hpp"
#include "estimator/numerics/noise_estimate.hpp"
#include "estimator/signal_guard.hpp"

namespace touchdown {

/// The vertical force of the ground on each wheel, by the equations of motion of its leg
/// (docs/explanation/contact.md). From the torques τ of a leg's joints, its motion and that of the
/// torso, the force F on the axle follows as
///
///     L₁ e₁·F = h₁ − τ₁ + τ₂,   L₂ e₂·F = h₂ − τ₂ − τ_w,
///
/// where h₁ and h₂ are the moments that gravity and the acceleration of links, wheel and rotors
/// take. All motion is low-passed alike. F is computed twice, with the measured torques and with
/// those by the laws of the servos; both are weighted by their variances, which contain the noise
/// of the sensors as it is observed. Forces without a scale of their own are shares of the weight.
///
/// Both loads together accelerate the robot, so that a third equation connects them,
///
///     F_left + F_right = m s + the motion of both legs relative to the torso,
///
/// with the specific force s of the hips. It gives the loads of straight legs, whose torques show
/// none, and the accelerometer's own error, which the torques contradict. A force on the torso,
/// such as a hand's, contradicts it for longer, and then counts as the sum's error.
///
/// Rolling resistance is not modelled. On a tyre the ground takes its moment; simulators have it as
/// a torque between wheel and lower leg, which adds 1.4 % of the weight to the load of a rolling
/// Upkie.
class DynamicLoads {
 public:
  using Loads = std::array<WheelLoad, 2>;

  DynamicLoads(const LegGeometry& geometry, double sample_rate,
               const SignalGuardConfig& guard = {});

  /// Forgets all earlier steps.
  void reset() noexcept;
  /// The next signals do not follow the earlier ones. The noise levels stay.
  void restart() noexcept;

  /// The loads of a step. NaN for a leg without usable signals, and for both without a usable IMU.
  /// A signal that is missing for longer than the guard's gap starts anew. A straight leg has a
  /// load with a large deviation. `has_acceleration`: the guard's verdict on it.
  Loads update(const Signals& signals, bool has_acceleration = true) noexcept;

  /// Whether the last step had the load by the servos' laws, of both legs.
  [[nodiscard]] bool has_targets() const noexcept { return has_targets_; }
  /// The loads as beliefs report them: NaN instead of those with a deviation beyond a quarter of
  /// the robot's weight.
  [[nodiscard]] Loads known(const Loads& loads) const noexcept;
  /// N
  [[nodiscard]] double weight() const noexcept { return weight_; }

 private:
  /// First-order low-passes with one gain, which start at their first input.
  template <int size>
  struct LowPass {
    using Values = Eigen::Matrix<double, size, 1>;

    Values value = Values::Zero();
    Values change = Values::Zero();  ///< since the step before
    bool is_started = false;

    void update(const Values& input, double gain) noexcept {
      change = is_started ? Values(gain * (input - value)) : Values::Zero();
      value = is_started ? Values(value + change) : input;
      is_started = true;
    }
  };
  /// Of the torso: x forward, y left, z up.
  struct Torso {
    LowPass<3> aligned;  ///< specific force of the IMU (m/s²), delayed as the torques
    LowPass<3> specific_force;
    LowPass<3> turn;  ///< rad/s
    Eigen::Vector3d turn_acceleration = Eigen::Vector3d::Zero();
    Eigen::Vector2d up = Eigen::Vector2d::UnitY();  ///< in the leg's plane: forward, upward
  };
  /// −τ₁ + τ₂ and −τ₂ − τ_w, low-passed twice: as long as servos low-pass their velocities, then as
  /// all motion.
  struct Moments {
    LowPass<2> aligned;
    LowPass<2> value;
  };
  /// Of one leg, in the left leg's signs.
  struct Leg {
    LowPass<3> rate;  ///< of upper link, lower link and wheel (rad/s)
    Moments by_torques;
    Moments by_servos;
    double time = 0.0;  ///< of the last usable signals (s)
  };
  struct LegTorques;
  /// White noise of both legs' joints of a kind (N·m): sensors of joints may differ.
  struct JointNoise {
    NoiseEstimate<2> hip, knee, wheel;

    explicit JointNoise(const NoiseEstimate<2>& alike) : hip(alike), knee(alike), wheel(alike) {}
    void update(const std::array<LegTorques, 2>& torque) noexcept;
    void reset() noexcept;
    void reset_signals() noexcept;
  };
  struct LegLoad;
  struct Links;
  struct Levers;
  /// The sum of both loads by the torques minus that by the accelerometer.
  struct Balance {
    LowPass<1> lasting;  ///< N
    LowPass<1> passing;  ///< N²
  };

  void update_torso(const Signals& signals) noexcept;
  void observe_noise(const Signals& signals, bool has_imu, const std::array<bool, 2>& has_leg,
                     const std::array<LegTorques, 2>& by_servos) noexcept;
  [[nodiscard]] LegTorques servo_torques(const LegSignals& leg,
                                         const LegTargets& target) const noexcept;
  void update_moments(Moments& moments, const LegTorques& torque, const LegSignals& leg,
                      double sign) const noexcept;
  [[nodiscard]] Levers levers(const Links& links, const Eigen::Vector2d& required) const noexcept;
  LegLoad update_leg(std::size_t side, const LegSignals& signals,
                     const LegTorques& by_servos) noexcept;
  /// (m/s²)², low-passed
  [[nodiscard]] double acceleration_variance() const noexcept;
  /// Connects both loads by their sum.
  Loads balanced(const std::array<LegLoad, 2>& by_leg) noexcept;

  LegGeometry geometry_;
  SignalGuardConfig guard_;
  bool has_hip_;
  double rate_;  ///< Hz
  double gain_;
  double alignment_gain_;
  double contradiction_gain_;
  double white_;            ///< share of a white variance that the low-pass leaves …
  double white_of_change_;  ///< … and its factor in the derivative (1/s²)
  double weight_;
  // By the leg's equations of motion (kg, kg·m²):
  double leg_mass_;
  double upper_mass_;  ///< A/L₁, at the knee
  double lower_mass_;  ///< B/L₂, at the axle
  double upper_inertia_;
  double lower_inertia_;
  double model_variance_;  ///< N²
  double torque_variance_;
  double servo_variance_;  ///< N²·m²
  /// Of the low-pass of the acceleration, which lasts longer with more noise, by noise level.
  std::vector<double> acceleration_gain_;
  JointNoise torque_noise_;          ///< as measured
  JointNoise servo_noise_;           ///< by the servos' laws
  NoiseEstimate<4> velocity_noise_;  ///< rad/s
  NoiseEstimate<1> acceleration_noise_;
  Torso torso_;
  double torso_time_ = 0.0;
  bool has_targets_ = false;
  std::array<Leg, 2> leg_;
  Balance balance_;
};

}  // namespace touchdown
