#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "estimator/signal_guard.hpp"
#include "estimator/signals.hpp"

namespace touchdown::experiments {

/// Lengths of the means, 2 to 100 ms, and indices of the two that also have standard deviations.
inline constexpr std::array<double, 6> window_lengths = {0.002, 0.005, 0.01,
                                                         0.02,  0.05,  0.1};  ///< s
inline constexpr std::array<std::size_t, 2> window_deviations = {2, 5};  ///< of `window_lengths`
/// The current value, its means and its standard deviations.
inline constexpr std::size_t channel_features =
    1 + window_lengths.size() + window_deviations.size();
/// Torques of knee and wheel of the wheel's own leg, then of the other leg, then the acceleration.
inline constexpr std::size_t window_channels = 5;
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

/// The trees' input features of both wheels, for fits and estimates alike. They cover 100 ms of the
/// phase filter's signals: torques of knees and wheels, and the vertical acceleration. A missing
/// value repeats the last one, up to the guard's `maximum_gap`.
class SignalWindow {
 public:
  /// Result of one update.
  struct Step {
    SignalStatus status = SignalStatus::good;
    double elapsed = 0.0;   ///< since the previous step (s)
    bool is_valid = false;  ///< whether this step has features
  };

  /// Throws InputError for a rate that is not positive.
  explicit SignalWindow(double sample_rate, const SignalGuardConfig& config = {});

  void reset() noexcept;
  Step update(const Signals& signals) noexcept;

  /// Features with the signs of the left leg.
  [[nodiscard]] WindowFeatures features(std::size_t side) const noexcept;
  /// A belief after `elapsed` seconds without valid signals.
  [[nodiscard]] double relaxed(double p_contact, double elapsed) const noexcept {
    return guard_.relaxed(p_contact, elapsed);
  }

 private:
  SignalGuardConfig config_;
  SignalGuard guard_;
  /// Left knee, left wheel, right knee, right wheel, acceleration.
  std::vector<ChannelWindow> channels_;
  std::array<double, window_channels> last_{};
  std::array<double, window_channels> missing_for_{};  ///< s; infinite before the first value
};

}  // namespace touchdown::experiments
