#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "estimator/contact_estimator.hpp"
#include "estimator/decision/feature_extractor.hpp"
#include "estimator/force/leg_geometry.hpp"
#include "estimator/signal_guard.hpp"
#include "estimator/signals.hpp"

namespace touchdown::experiments {

/// What inputs of boosted trees depend on.
struct TreeInputsConfig {
  double sample_rate = 1000.0;  ///< Hz
  LegGeometry legs = {};        ///< for inputs that use it
  bool servo_load = false;      ///< whether targets of the servos are used
};

/// Result of one update of such inputs.
struct TreeInputsStep {
  SignalStatus status = SignalStatus::good;
  double elapsed = 0.0;               ///< since the previous step (s)
  std::array<bool, 2> is_valid = {};  ///< whether a wheel has features in this step; left, right
};

/// Inputs of boosted trees: exactly those of the recommended estimator, its channels at all time
/// scales and both noise levels. The channel of the servo law is 0 in a fit without it.
class ChannelInputs {
 public:
  static constexpr std::size_t count = decision_inputs + 2 * decision_scales;
  using Features = std::array<float, count>;

  /// Throws InputError for an invalid configuration.
  explicit ChannelInputs(const TreeInputsConfig& config);

  void reset() noexcept { extractor_.reset(); }
  TreeInputsStep update(const Signals& signals) noexcept;

  /// Features with the signs of the left leg, as of the last valid step.
  [[nodiscard]] Features features(std::size_t side) const noexcept;
  /// A belief after `elapsed` seconds without valid signals.
  [[nodiscard]] double relaxed(double p_contact, double elapsed) const noexcept {
    return extractor_.relaxed(p_contact, elapsed);
  }

 private:
  FeatureExtractor extractor_;
};

/// Lengths of the means, 2 to 100 ms, and indices of the two that also have standard deviations.
inline constexpr std::array<double, 6> window_lengths = {0.002, 0.005, 0.01,
                                                         0.02,  0.05,  0.1};  ///< s
inline constexpr std::array<std::size_t, 2> window_deviations = {2, 5};  ///< of `window_lengths`
/// The current value, its means and its standard deviations.
inline constexpr std::size_t channel_features =
    1 + window_lengths.size() + window_deviations.size();
/// Of each leg: torques of hip, knee and wheel, positions of hip and knee, velocities of all three,
/// and the torques of hip and knee by the laws of their servos, which are 0 without targets.
inline constexpr std::size_t window_leg_channels = 10;
/// Own leg, other leg, vertical acceleration, angular velocity (3).
inline constexpr std::size_t window_channels = 2 * window_leg_channels + 4;
inline constexpr std::size_t window_features = window_channels * channel_features;
using WindowFeatures = std::array<float, window_features>;

/// The last 100 ms of one channel. Times before the first value count with that value.
class ChannelWindow {
 public:
  using Features = std::array<float, channel_features>;

  explicit ChannelWindow(double sample_rate);

  void reset() noexcept { is_started_ = false; }
  /// Takes a finite value.
  void update(double value) noexcept;
  [[nodiscard]] Features features() const noexcept;

 private:
  struct Sums {
    double values = 0.0;
    double squares = 0.0;
  };

  std::array<std::size_t, window_lengths.size()> steps_{};  ///< of each length
  std::array<Sums, window_lengths.size()> sums_{};
  std::vector<double> values_;  ///< ring buffer of the last values, minus `zero_`
  std::size_t next_ = 0;
  double zero_ = 0.0;  ///< the first value, subtracted to keep sums of squares accurate
  double last_ = 0.0;
  bool is_started_ = false;
};

/// Inputs of boosted trees: 100 ms of all raw signals, and the torques by the laws of the servos. A
/// missing value repeats the last one, up to the guard's `maximum_gap`.
class SignalWindow {
 public:
  static constexpr std::size_t count = window_features;

  /// Throws InputError for a rate that is not positive.
  explicit SignalWindow(const TreeInputsConfig& inputs, const SignalGuardConfig& config = {});

  void reset() noexcept;
  TreeInputsStep update(const Signals& signals) noexcept;

  /// Features with the signs of the left leg.
  [[nodiscard]] WindowFeatures features(std::size_t side) const noexcept;
  /// A belief after `elapsed` seconds without valid signals.
  [[nodiscard]] double relaxed(double p_contact, double elapsed) const noexcept {
    return guard_.relaxed(p_contact, elapsed);
  }

 private:
  /// The values of all channels; NaN for those that are unusable.
  [[nodiscard]] std::array<double, window_channels> values_of(const Signals& signals,
                                                              bool has_acceleration) const noexcept;

  SignalGuardConfig config_;
  bool uses_targets_;
  SignalGuard guard_;
  /// Those of the left leg, of the right leg, and the common ones.
  std::vector<ChannelWindow> channels_;
  std::array<double, window_channels> last_{};
  std::array<double, window_channels> missing_for_{};  ///< s; infinite before the first value
};

}  // namespace touchdown::experiments
