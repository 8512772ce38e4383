#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <span>

namespace touchdown {

/// The last two samples of one channel, for its second difference.
class SecondDifference {
 public:
  void reset() noexcept { samples_ = 0; }

  /// Takes a sample. Returns whether the last three were finite, so that there is a second
  /// difference.
  bool update(double x) noexcept {
    if (!std::isfinite(x)) {
      samples_ = 0;
      return false;
    }
    magnitude_ = std::abs(x - 2.0 * previous_ + before_);
    before_ = previous_;
    previous_ = x;
    samples_ = std::min(samples_ + 1, 3);
    return samples_ == 3;
  }

  /// |x_t − 2 x_{t−1} + x_{t−2}|
  [[nodiscard]] double magnitude() const noexcept { return magnitude_; }

 private:
  double previous_ = 0.0;
  double before_ = 0.0;
  double magnitude_ = 0.0;
  int samples_ = 0;
};

/// Estimates the standard deviation of the white noise on `channels` signals with the same noise.
/// The second difference of white noise has the standard deviation √6 σ, and half of its magnitudes
/// lie below 0.6745·√6 σ. The estimate rises by a small factor when one lies above, falls by it
/// when one lies below, and settles where both happen equally often. Signals much smoother than
/// their noise, and rare shocks, hardly move it. The estimate moves over precomputed levels, so
/// that a step costs neither an exponential nor a logarithm. Copies share the levels. Never fails;
/// skips samples that are not finite.
template <std::size_t channels>
class NoiseEstimate {
 public:
  /// Covers `floor` to at least `ceiling`. An update moves the estimate by a relative step of
  /// `gain`, and by more during the first `warm_up` updates.
  NoiseEstimate(double floor, double ceiling, double gain, double warm_up)
      : log_floor_(std::log(floor)),
        log_step_(gain / static_cast<double>(channels)),
        warm_up_(warm_up) {
    top_ = std::max(1, static_cast<int>(std::ceil(std::log(ceiling / floor) / log_step_)));
    const auto sigma = std::make_shared<double[]>(static_cast<std::size_t>(top_) + 1);
    for (int i = 0; i <= top_; ++i) sigma[i] = floor * std::exp(i * log_step_);
    sigma_ = sigma;
  }

  void reset() noexcept {
    level_ = 0;
    updates_ = 0.0;
    reset_signals();
  }

  /// The next samples do not follow the last ones. The estimate stays.
  void reset_signals() noexcept {
    for (SecondDifference& channel : difference_) channel.reset();
  }

  void update(const std::array<double, channels>& samples) noexcept {
    const double median = 0.6744897501960817 * 2.449489742783178 * sigma();
    int direction = 0;
    bool usable = false;
    for (std::size_t i = 0; i < channels; ++i) {
      if (!difference_[i].update(samples[i])) continue;
      usable = true;
      direction += difference_[i].magnitude() > median ? 1 : -1;
    }
    if (!usable) return;
    updates_ += 1.0;
    const int stride = updates_ < warm_up_ ? static_cast<int>(warm_up_ / updates_) : 1;
    level_ = static_cast<std::size_t>(
        std::clamp(static_cast<int>(level_) + direction * stride, 0, top_));
  }

  [[nodiscard]] double sigma() const noexcept { return sigma_.get()[level_]; }
  /// Its natural logarithm, without computing one.
  [[nodiscard]] double log_sigma() const noexcept {
    return log_floor_ + log_step_ * static_cast<double>(level_);
  }
  /// The index of the estimate among `levels`.
  [[nodiscard]] std::size_t level() const noexcept { return level_; }
  /// All standard deviations that the estimate can take, increasing.
  [[nodiscard]] std::span<const double> levels() const noexcept {
    return {sigma_.get(), static_cast<std::size_t>(top_) + 1};
  }

 private:
  std::shared_ptr<const double[]> sigma_;
  int top_ = 0;  ///< the highest level
  double log_floor_;
  double log_step_;  ///< between levels
  double warm_up_;
  std::size_t level_ = 0;
  double updates_ = 0.0;
  std::array<SecondDifference, channels> difference_;
};

}  // namespace touchdown
