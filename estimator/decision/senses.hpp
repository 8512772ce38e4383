#pragma once

#include <array>
#include <cstddef>

#include "estimator/decision/channels.hpp"
#include "estimator/decision/network.hpp"
#include "estimator/numerics/noise_estimate.hpp"
#include "estimator/signal_guard.hpp"

namespace touchdown {

/// Where each channel's compression, y → asinh(y / bend), begins to bend: a leg's load (N),
/// reaction (N·m), axle velocity (m/s) and axle acceleration (m/s²), …
inline constexpr std::array<float, decision_leg_channels> leg_bends = {5.0F, 0.1F, 0.1F, 3.0F};
/// … vertical acceleration (m/s²) and roll rate (rad/s).
inline constexpr float acceleration_bend = 3.0F;
inline constexpr float roll_rate_bend = 0.3F;

/// First-order low-passes of 1, 2, 4, … 128 ms, side by side. Starts at its first input.
class TimeScales {
 public:
  using Values = std::array<float, decision_scales>;

  explicit TimeScales(double sample_rate) noexcept;

  void reset() noexcept { is_started_ = false; }
  void update(double input) noexcept;
  [[nodiscard]] const Values& values() const noexcept { return values_; }

 private:
  Values gains_{};
  Values values_{};
  bool is_started_ = false;
};

/// From signals to what the network hears of both wheels, alike when fitting and when estimating.
class DecisionSenses {
 public:
  /// What became of one step.
  struct Step {
    SignalStatus status = SignalStatus::good;
    double elapsed = 0.0;               ///< since the previous step (s)
    bool restart = false;               ///< what was heard before does not precede this
    std::array<bool, 2> is_heard = {};  ///< whether there are inputs of this step; left, right
  };

  /// Throws InputError for a configuration that makes no sense.
  explicit DecisionSenses(const DecisionConfig& config);

  void reset() noexcept;
  Step update(const Signals& signals) noexcept;

  /// Makes the network's inputs of what was heard so far.
  void arrange() noexcept;
  /// As they were last arranged.
  [[nodiscard]] const DecisionInputs& inputs(std::size_t side) const noexcept {
    return inputs_[side];
  }
  /// The estimated white noise of torques (N·m).
  [[nodiscard]] double torque_noise() const noexcept { return torque_noise_.sigma(); }
  /// A belief after `elapsed` seconds without news.
  [[nodiscard]] double relaxed(double p_contact, double elapsed) const noexcept {
    return guard_.relaxed(p_contact, elapsed);
  }

 private:
  using LegScales = std::array<TimeScales, decision_leg_channels>;

  void restart() noexcept;

  SignalGuardConfig config_;
  SignalGuard guard_;
  std::array<LegListener, 2> listener_;
  std::array<LegScales, 2> leg_;
  TimeScales acceleration_;
  TimeScales roll_rate_;
  NoiseEstimate<2> torque_noise_;
  NoiseEstimate<1> acceleration_noise_;
  std::array<DecisionInputs, 2> inputs_{};
};

}  // namespace touchdown
