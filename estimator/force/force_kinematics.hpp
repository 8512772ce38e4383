#pragma once

#include <array>

#include "estimator/contact_estimator.hpp"
#include "estimator/force/leg_geometry.hpp"
#include "estimator/force/wheel_loads.hpp"

namespace touchdown {

/// The observation of one wheel at one step.
struct WheelObservation {
  double force = 0.0;          ///< of the ground, upwards (N)
  double axle_velocity = 0.0;  ///< upwards (m/s)
};

/// The distribution of a wheel's observations in one of its two states, and the rate at which the
/// wheel leaves the state.
struct WheelState {
  double force_mean = 0.0;       ///< N
  double force_deviation = 1.0;  ///< N
  double axle_deviation = 1.0;   ///< of a velocity with zero mean (m/s)
  double leaving_rate = 1.0;     ///< one over the state's mean duration (1/s)

  bool operator==(const WheelState&) const = default;
};

/// The model, the same for both wheels.
struct ForceKinematicsModel {
  WheelState air;
  WheelState contact;

  bool operator==(const ForceKinematicsModel&) const = default;
};

/// Settings, chosen on runs of seed 2 (docs/explanation/estimator.md).
struct ForceKinematicsConfig {
  double sample_rate = 1000.0;  ///< at which `update` is called (Hz)
  LegGeometry geometry = {};
  double low_pass = 0.007;  ///< time constant of the low-pass of the force (s)
  /// The force is limited to this (N) before the low-pass: somewhat more than twice the load of one
  /// wheel of Upkie. Otherwise landings would widen the Gaussian of contact until it includes light
  /// forces.
  double largest_force = 60.0;
  double leak = 0.3;       ///< time constant with which the torso's velocity decays (s)
  double threshold = 0.5;  ///< in contact from this probability on
  SignalGuardConfig guard = {};
};

/// The vertical velocity of each axle, by differential kinematics of the legs. The torso's velocity
/// is a leaky integral of its acceleration. Estimators and their fits use the same one.
class AxleMotion {
 public:
  explicit AxleMotion(const ForceKinematicsConfig& config) noexcept;

  /// Resets all state: the next step does not follow the previous ones.
  void reset() noexcept;

  /// `acceleration`: upward acceleration of the torso (m/s²), or 0 if it is unknown.
  void update(const Signals& signals, double acceleration) noexcept;

  /// Whether the last step measured this leg.
  [[nodiscard]] bool is_measured(std::size_t side) const noexcept { return is_measured_[side]; }
  /// The last measured velocity, upwards (m/s).
  [[nodiscard]] double velocity(std::size_t side) const noexcept { return velocity_[side]; }

 private:
  LegGeometry geometry_;
  double time_step_;
  double leak_;
  double torso_ = 0.0;  ///< m/s, upwards
  std::array<double, 2> velocity_ = {};
  std::array<bool, 2> is_measured_ = {};
};

/// Computes the observations of both wheels from usable signals. The filter and its fit use the
/// same one.
class WheelObservations {
 public:
  explicit WheelObservations(const ForceKinematicsConfig& config);

  void reset() noexcept;
  /// If this step does not measure a wheel, its last observation stays.
  WheelLoads::Step update(const Signals& signals) noexcept;
  [[nodiscard]] WheelObservation of(std::size_t side) const noexcept {
    return {loads_.force(side), motion_.velocity(side)};
  }
  [[nodiscard]] double relaxed(double p_contact, double elapsed) const noexcept {
    return loads_.relaxed(p_contact, elapsed);
  }

 private:
  WheelLoads loads_;
  AxleMotion motion_;
};

/// log P(observation | contact) − log P(observation | no contact), by independent Gaussians. The
/// force is clamped between the means of both states: a force above that of contact must not count
/// as air, whichever Gaussian is wider.
[[nodiscard]] double log_likelihood_ratio(const ForceKinematicsModel& model,
                                          const WheelObservation& observation) noexcept;

/// Published for legged robots: Hwangbo, Bellicoso, Fankhauser, Hutter, "Probabilistic foot contact
/// estimation by fusing information from dynamics and differential/forward kinematics" (IROS 2016).
/// The paper has a hidden Markov model of each foot with the states contact and no contact. The
/// observations are the contact force that explains the dynamics and the velocity of the foot,
/// which on the ground is zero up to a small noise. Forward kinematics, as the foot's height, drive
/// the transitions. Written from memory of the paper. Adapted to wheels as follows:
///
/// - dynamics: the vertical force of each leg (`vertical_force`) is Gaussian in each state;
/// - differential kinematics: a wheel rolls, so on level ground only its axle's vertical velocity
/// is
///   zero. It is the sum of the torso's, a leaky integral of its acceleration, and the leg's;
/// - a wheel's acceleration in place of a foot's slip was tried and left out: in the fitted runs it
///   is larger on the ground, where landings spin wheels up, than in the air;
/// - there is no map of the ground to compare heights with: transitions have the rates of the
/// fitted
///   runs;
/// - both wheels share one model, fitted to labelled runs.
///
/// `update` never throws, allocates or locks, and never returns NaN. While the acceleration or a
/// leg's joints are not usable, the belief relaxes to the prior and the status gives the reason.
class ForceKinematics : public ContactEstimator {
 public:
  /// Throws InputError for a model with numbers that are not finite, or deviations or rates that
  /// are not positive. Also for a sample rate, length, leak or largest force that is not positive,
  /// a negative time constant, and a threshold outside (0, 1).
  explicit ForceKinematics(const ForceKinematicsModel& model,
                           const ForceKinematicsConfig& config = {});

  void reset() noexcept override;

 private:
  const Belief& estimate(const Signals& signals) noexcept override;

  ForceKinematicsModel model_;
  WheelObservations observations_;
  double threshold_;
  double log_deviation_ratio_;
  double takeoff_;  ///< P(no contact now | contact before)
  double landing_;
  std::array<double, 2> p_air_ = {0.5, 0.5};  ///< kept because the belief may round to one
  Belief belief_;
};

}  // namespace touchdown
