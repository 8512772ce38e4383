#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "estimator/signal_guard.hpp"
#include "estimator/signals.hpp"

namespace touchdown::experiments {

/// Means over 2, 5, 10, 20, 50 and 100 ms, and standard deviations over two of them.
inline constexpr std::array<double, 6> window_lengths = {0.002, 0.005, 0.01,
                                                         0.02,  0.05,  0.1};  ///< s
inline constexpr std::array<std::size_t, 2> window_deviations = {2, 5};  ///< of `window_lengths`
/// The value now, its means, its deviations.
inline constexpr std::size_t channel_features =
    1 + window_lengths.size() + window_deviations.size();
/// Knee and wheel of the wheel's own leg, knee and wheel of the other leg, the acceleration.
inline constexpr std::size_t window_channels = 5;
inline constexpr std::size_t window_features = window_channels * channel_features;
using WindowFeatures = std::array<float, window_features>;

/// The last 100 ms of one channel. Before its first value it is taken to have been that value.
class ChannelWindow {
 public:
  using Features = std::array<float, channel_features>;

  explicit ChannelWindow(double sample_rate);

  void reset() noexcept { is_started_ = false; }
  /// A finite value.
  void update(double value) noexcept;
  [[nodiscard]] Features features() const noexcept;

 private:
  struct Sums {
    double values = 0.0;
    double squares = 0.0;
  };

  std::array<std::size_t, window_lengths.size()> steps_{};  ///< of each length
  std::array<Sums, window_lengths.size()> sums_{};
  std::vector<double> values_;  ///< the last ones, in turn; less `zero_`
  std::size_t next_ = 0;
  double zero_ = 0.0;  ///< the first value: sums of squares about it lose nothing
  double last_ = 0.0;
  bool is_started_ = false;
};

/// What the trees hear of both wheels, alike when fitting and when estimating: torques of knees and
/// wheels and the vertical acceleration, as the phase filter does, over 100 ms. A value that is
/// missing repeats the last one for as long as a gap may take.
class SignalWindow {
 public:
  /// What became of one step.
  struct Step {
    SignalStatus status = SignalStatus::good;
    double elapsed = 0.0;   ///< since the previous step (s)
    bool is_valid = false;  ///< whether there are features of this step
  };

  /// Throws InputError for a rate that is not positive.
  explicit SignalWindow(double sample_rate, const SignalGuardConfig& config = {});

  void reset() noexcept;
  Step update(const Signals& signals) noexcept;

  /// In the left leg's signs.
  [[nodiscard]] WindowFeatures features(std::size_t side) const noexcept;
  /// A belief after `elapsed` seconds without news.
  [[nodiscard]] double relaxed(double p_contact, double elapsed) const noexcept {
    return guard_.relaxed(p_contact, elapsed);
  }

 private:
  SignalGuardConfig config_;
  SignalGuard guard_;
  /// Left knee, left wheel, right knee, right wheel, acceleration.
  std::vector<ChannelWindow> channels_;
  std::array<double, window_channels> last_{};
  std::array<double, window_channels> missing_for_{};  ///< s; endless before the first value
};

}  // namespace touchdown::experiments
