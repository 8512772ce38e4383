#pragma once

#include <array>
#include <cstddef>

#include "estimator/decision/leg_features.hpp"
#include "estimator/decision/network.hpp"
#include "estimator/decision/repetition.hpp"
#include "estimator/numerics/noise_estimate.hpp"
#include "estimator/signal_guard.hpp"

namespace touchdown {

/// What is large differs less than what is small: with y = value / bend every channel is heard as
/// y / (1 + |y| / largest), which tends to this.
inline constexpr float saturation = 4.0F;
/// Where the compression begins to bend: of a leg's load (N), reaction (N·m), axle velocity (m/s)
/// and axle acceleration (m/s²), …
inline constexpr std::array<float, decision_leg_channels> leg_softsign_scales = {5.0F, 0.1F, 0.1F, 3.0F};
/// … vertical acceleration (m/s²) and roll rate (rad/s).
inline constexpr float acceleration_softsign_scale = 3.0F;
inline constexpr float roll_rate_softsign_scale = 0.3F;
/// Which senses these are: what was fitted to others is no model for them.
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
  /// Takes the input for what there was in `seconds` without one, which the next update ends.
  void fast_forward(double input, double seconds) noexcept;
  [[nodiscard]] const Values& values() const noexcept { return values_; }

 private:
  Values gains_{};
  Values values_{};
  bool is_started_ = false;
};

/// From signals to what the network hears of both wheels, alike when fitting and when estimating.
class FeatureExtractor {
 public:
  /// What became of one step.
  struct Step {
    SignalStatus status = SignalStatus::good;
    double elapsed = 0.0;               ///< since the previous step (s)
    bool restart = false;               ///< time jumped: what was believed is old
    std::array<bool, 2> is_valid = {};  ///< whether there are inputs of this step; left, right
  };

  /// Throws InputError for a configuration that makes no sense.
  explicit FeatureExtractor(const DecisionConfig& config);

  void reset() noexcept;
  /// The low-passes begin anew with what comes next; noise levels and silent sensors stay known.
  void reset_features() noexcept;
  Step update(const Signals& signals) noexcept;

  /// Makes the network's inputs of what was heard so far.
  void arrange() noexcept;
  /// As they were last arranged: of the left wheel, of one wheel, of both.
  [[nodiscard]] const DecisionInputs& left_inputs() const noexcept { return heard_; }
  [[nodiscard]] DecisionInputs inputs(std::size_t side) const noexcept {
    return side == 0 ? heard_ : of_other_wheel(heard_);
  }
  [[nodiscard]] const DecisionPairInputs& pair_inputs() const noexcept { return pair_; }
  /// The estimated white noise of torques (N·m) of a robot of Upkie's mass, as dense as at 1 kHz:
  /// at a lower rate there are fewer samples of it to average.
  [[nodiscard]] double torque_noise() const noexcept { return density_ * torque_noise_.sigma(); }
  /// A belief after `elapsed` seconds without news.
  [[nodiscard]] double relaxed(double p_contact, double elapsed) const noexcept {
    return guard_.relaxed(p_contact, elapsed);
  }

 private:
  using LegFilters = std::array<LowPassBank, decision_leg_channels>;

  void dropout(double seconds) noexcept;
  bool is_frozen(const LegSignals& leg, std::size_t side) noexcept;
  void update(LowPassBank& channel, double input, double age) const noexcept;
  void update_legs(const Signals& signals, const std::array<bool, 2>& is_valid,
                 bool has_acceleration, double elapsed) noexcept;

  SignalGuardConfig config_;
  LegGeometry geometry_;
  double mass_ratio_;
  SignalGuard guard_;
  std::array<Repetition<9>, 2> leg_repetition_;
  Repetition<3> gyro_repetition_;
  std::array<LegFeatureExtractor, 2> listener_;
  std::array<LegFilters, 2> leg_;
  LowPassBank acceleration_;
  LowPassBank roll_rate_;
  double density_;  ///< what white noise at this rate is worth at 1 kHz
  double log_density_;
  /// For how long each of these has not been heard (s).
  std::array<double, 2> leg_age_{};
  double acceleration_age_ = 0.0;
  double roll_rate_age_ = 0.0;
  NoiseEstimate<2> torque_noise_;
  NoiseEstimate<1> acceleration_noise_;
  alignas(32) DecisionInputs heard_{};     ///< of the left wheel
  alignas(32) DecisionPairInputs pair_{};  ///< of both
};

}  // namespace touchdown
