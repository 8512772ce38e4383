#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "estimator/numerics/noise_estimate.hpp"

namespace touchdown::experiments {

/// `NoiseEstimate` of two signals for many noise levels side by side. The estimate of each element
/// equals that of a `NoiseEstimate` with its samples, which must be finite.
class NoiseEstimates {
 public:
  /// `one` holds the levels of each estimate; `warm_up` is its number of first updates.
  NoiseEstimates(const NoiseEstimate<2>& one, double warm_up, std::size_t count)
      : warm_up_(warm_up),
        top_(static_cast<std::int32_t>(one.levels().size()) - 1),
        level_(count, 0) {
    constexpr double median_of_second_difference = 0.6744897501960817 * 2.449489742783178;
    for (const double sigma : one.levels()) {
      median_.push_back(median_of_second_difference * sigma);
    }
    for (auto* samples : {&previous_, &before_}) samples->fill(std::vector<double>(count, 0.0));
  }

  /// The next samples of both signals, by element.
  void update(const std::array<std::vector<double>, 2>& samples) noexcept {
    steps_ = std::min(steps_ + 1, 3);
    const bool is_usable = steps_ == 3;
    if (is_usable) updates_ += 1.0;
    const std::int32_t stride = !is_usable ? 0
                                : updates_ < warm_up_
                                    ? static_cast<std::int32_t>(warm_up_ / updates_)
                                    : 1;
    const std::size_t count = level_.size();
    const double* const first = samples[0].data();
    const double* const second = samples[1].data();
    double* const previous_first = previous_[0].data();
    double* const previous_second = previous_[1].data();
    double* const before_first = before_[0].data();
    double* const before_second = before_[1].data();
    const double* const median = median_.data();
    std::int32_t* const level = level_.data();
    const std::int32_t top = top_;
    // The arrays do not overlap, which the compiler cannot know.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC ivdep
#endif
    for (std::size_t i = 0; i < count; ++i) {
      const double a = std::abs(first[i] - 2.0 * previous_first[i] + before_first[i]);
      const double b = std::abs(second[i] - 2.0 * previous_second[i] + before_second[i]);
      before_first[i] = previous_first[i];
      before_second[i] = previous_second[i];
      previous_first[i] = first[i];
      previous_second[i] = second[i];
      const double now = median[level[i]];
      const std::int32_t direction = (a > now ? 1 : -1) + (b > now ? 1 : -1);
      level[i] = std::min(std::max(level[i] + direction * stride, 0), top);
    }
  }

  /// The index of each element's estimate among the levels.
  [[nodiscard]] std::size_t level(std::size_t element) const noexcept {
    return static_cast<std::size_t>(level_[element]);
  }

 private:
  double warm_up_;
  std::int32_t top_;
  int steps_ = 0;
  double updates_ = 0.0;
  std::vector<double> median_;
  std::vector<std::int32_t> level_;
  std::array<std::vector<double>, 2> previous_;
  std::array<std::vector<double>, 2> before_;
};

}  // namespace touchdown::experiments
