#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "estimator/decision/config.hpp"
#include "estimator/decision/network.hpp"
#include "estimator/force/load_estimate.hpp"
#include "estimator/force/wheel_loads.hpp"
#include "estimator/numerics/noise_estimate.hpp"
#include "estimator/signal_guard.hpp"

namespace touchdown {

/// The features of one leg, in the left leg's signs.
struct LegFeatures {
  /// The load on the wheel (N), as far as its leg's torques show it: (d² μF + ε² F₀) / (d² + ε²).
  /// F is `vertical_force`, μ is `mass_ratio`, and d = L₁ L₂ sin q₂ is the determinant of the leg's
  /// Jacobian. A bent leg gives μF (in Upkie's crouch, F₀ weighs 2 %). A straight leg carries any
  /// load without torques; it gives F₀ = 15 N, which indicates neither contact nor air.
  /// ε² = (0.003 m²)² + (0.004 m²/(N·m) σ)²: the larger the torques' noise σ, the further a leg
  /// must be bent for its torques to count.
  double load = 0.0;
  /// The torque of the ground on the wheel (N·m), times μ: the part of the servo's torque that does
  /// not accelerate the wheel.
  double reaction = 0.0;
  /// The upward velocity of the axle relative to the hip (m/s).
  double axle_velocity = 0.0;
  /// The upward acceleration of the axle (m/s²): 0 while the wheel rolls on level ground, even if
  /// the torso falls.
  double axle_acceleration = 0.0;
  /// `vertical_force_times_determinant` by the torques (N·m²).
  double force_times_determinant = 0.0;
};

/// The load on the wheel by the servo law (N), computed as `LegFeatures::load`.
struct ServoLoadFeature {
  double load = 0.0;  ///< F₀ while muted
  /// Whether it is muted: a target is missing, or the hip or the knee has no position gain.
  bool is_muted = true;
};

/// μ = Upkie's mass / the robot's mass. Features are scaled to Upkie's mass, because all forces and
/// torques of a robot that is heavier throughout are larger in proportion.
[[nodiscard]] inline double mass_ratio(const LegGeometry& geometry) noexcept {
  return LegGeometry{}.robot_mass / geometry.robot_mass;
}

/// Computes the features of one leg from its signals.
class LegFeatureExtractor {
 public:
  LegFeatureExtractor(const DecisionConfig& config, bool mirrored);

  void reset() noexcept { count_ = 0; }
  /// Signals must be usable. `foot` is this leg's Jacobian in this pose, `torque_noise` (N·m) that
  /// of `FeatureExtractor`.
  LegFeatures update(const LegSignals& leg, const FootJacobian& foot, double vertical_acceleration,
                     double torque_noise) noexcept;

  /// Likewise, with ε² = (0.001 m²)² + (0.004 m²/(N·m) σ)²: σ is the noise of the positions'
  /// resolution.
  [[nodiscard]] ServoLoadFeature servo_load(const FootJacobian& foot,
                                            const ServoLoad& load) const noexcept;

 private:
  /// The load of `LegFeatures`, from a vertical force times the determinant (N·m²).
  /// ε is `least` (m²) without noise.
  [[nodiscard]] double load_of(const FootJacobian& foot, double force_times_area, double least,
                               double torque_noise) const noexcept;

  LegGeometry geometry_;
  double mass_ratio_;
  bool mirrored_;
  double rate_;
  /// The last velocities of the wheel (rad/s) and of the axle relative to the hip (m/s), as a ring.
  std::vector<std::array<double, 2>> velocities_;
  std::size_t next_ = 0;
  std::size_t count_ = 0;  ///< of velocities since the reset
};

/// Whether all signals behind a leg's features are usable.
[[nodiscard]] inline bool is_usable(const LegSignals& leg,
                                    const SignalGuardConfig& guard) noexcept {
  return has_load(leg, guard) && is_torque(leg.wheel.torque, guard) &&
         std::isfinite(leg.hip.velocity) && std::isfinite(leg.knee.velocity) &&
         std::isfinite(leg.wheel.velocity);
}

/// Each channel is compressed by a softsign: y / (1 + |y| / saturation) with y = value / scale. The
/// result tends to ± this for large values.
inline constexpr float saturation = 4.0F;
/// Softsign scales of a leg's load (N), reaction (N·m), axle velocity (m/s) and axle acceleration
/// (m/s²), …
inline constexpr std::array<float, decision_leg_channels> leg_softsign_scales = {5.0F, 0.1F, 0.1F,
                                                                                 3.0F};
/// … of the vertical acceleration (m/s²) and of the roll rate (rad/s).
inline constexpr float acceleration_softsign_scale = 3.0F;
inline constexpr float roll_rate_softsign_scale = 0.3F;
/// The version of this feature set. A model that was fitted to another version is refused.
inline constexpr int feature_set_version = 2;

/// First-order low-passes of 1, 2, 4, … 128 ms, side by side. Starts at its first input.
class LowPassBank {
 public:
  using Values = std::array<float, decision_scales>;

  explicit LowPassBank(double sample_rate) noexcept;

  void reset() noexcept { is_started_ = false; }
  void update(double input) noexcept {
    const auto x = static_cast<float>(input);
    if (!is_started_) values_.fill(x);
    is_started_ = true;
    for (std::size_t i = 0; i < decision_scales; ++i) values_[i] += gains_[i] * (x - values_[i]);
  }
  /// Catches up on `seconds` without an input, as if it had been `input` throughout. An update with
  /// the new input follows.
  void fast_forward(double input, double seconds) noexcept;
  [[nodiscard]] const Values& values() const noexcept { return values_; }

 private:
  Values gains_{};
  Values values_{};
  bool is_started_ = false;
};

/// Computes the network's inputs for both wheels from signals, in the fit and in the estimator.
class FeatureExtractor {
 public:
  /// The outcome of one step.
  struct Step {
    SignalStatus status = SignalStatus::good;
    double elapsed = 0.0;               ///< since the previous step (s)
    bool restart = false;               ///< time jumped: the belief is outdated
    std::array<bool, 2> is_valid = {};  ///< whether this step has inputs; left, right
  };

  /// Throws InputError for an invalid configuration.
  explicit FeatureExtractor(const DecisionConfig& config);

  void reset() noexcept;
  /// The low-passes restart at their next inputs. Noise levels and sensors' ages stay.
  void reset_features() noexcept;
  Step update(const Signals& signals) noexcept;

  /// Computes the inputs of a wheel from the signals so far, …
  void compute_inputs() noexcept;
  /// … and those of both wheels as sums and differences, for the network.
  void compute_pair_inputs() noexcept;
  /// The inputs as last computed: of the left wheel, of one wheel, of both.
  [[nodiscard]] const DecisionInputs& left_inputs() const noexcept { return inputs_; }
  [[nodiscard]] DecisionInputs inputs(std::size_t side) const noexcept {
    return side == 0 ? inputs_ : of_other_wheel(inputs_);
  }
  [[nodiscard]] const DecisionPairInputs& pair_inputs() const noexcept { return pair_; }
  /// Likewise the optional channel; zeros without it.
  [[nodiscard]] const ServoLoadInputs& left_servo_load() const noexcept { return servo_inputs_; }
  [[nodiscard]] ServoLoadInputs servo_load(std::size_t side) const noexcept {
    return side == 0 ? servo_inputs_ : of_other_wheel(servo_inputs_);
  }
  /// Whether the load by the servo law of a valid leg is muted at this step: a target or a gain is
  /// missing.
  [[nodiscard]] bool is_servo_load_muted() const noexcept { return is_muted_; }
  /// The estimated white noise of the torques (N·m), scaled to Upkie's mass and to a rate of 1 kHz:
  /// a lower rate has fewer samples to average.
  [[nodiscard]] double torque_noise() const noexcept { return density_ * torque_noise_.sigma(); }
  /// The normal force on a wheel at this step.
  [[nodiscard]] const WheelLoad& load(std::size_t side) const noexcept { return load_[side]; }
  /// A belief after `elapsed` seconds without a measurement.
  [[nodiscard]] double relaxed(double p_contact, double elapsed) const noexcept {
    return guard_.relaxed(p_contact, elapsed);
  }

 private:
  using LegFilters = std::array<LowPassBank, decision_leg_channels>;

  void dropout(double seconds) noexcept;
  void write_noise(float* inputs) const noexcept;
  bool is_frozen(const LegSignals& leg, std::size_t side) noexcept;
  void update(LowPassBank& channel, double input, double age) const noexcept;
  void update_servo_load(const ServoLoad& load, std::size_t side, const FootJacobian& foot,
                         double age) noexcept;
  void update_legs(const Signals& signals, const std::array<bool, 2>& is_valid,
                   bool has_acceleration, double elapsed) noexcept;

  SignalGuardConfig config_;
  LegGeometry geometry_;
  double mass_ratio_;
  SignalGuard guard_;
  std::array<Repetition<9>, 2> leg_repetition_;
  Repetition<3> gyro_repetition_;
  std::array<LegFeatureExtractor, 2> leg_extractor_;
  std::array<LegFilters, 2> leg_;
  bool has_servo_load_;
  std::array<LowPassBank, 2> servo_load_;
  bool is_muted_ = false;  ///< the load by the servo law
  LowPassBank acceleration_;
  LowPassBank roll_rate_;
  double density_;  ///< factor from white noise at this rate to the same at 1 kHz
  double log_density_;
  /// The age of each sensor: time since its last usable signal (s).
  std::array<double, 2> leg_age_{};
  double acceleration_age_ = 0.0;
  double roll_rate_age_ = 0.0;
  NoiseEstimate<2> torque_noise_;
  NoiseEstimate<1> acceleration_noise_;
  LoadEstimates load_estimates_;
  std::array<WheelLoad, 2> load_;
  alignas(32) DecisionInputs inputs_{};         ///< of the left wheel
  alignas(32) DecisionPairInputs pair_{};       ///< of both
  alignas(32) ServoLoadInputs servo_inputs_{};  ///< of the left wheel
};

}  // namespace touchdown
