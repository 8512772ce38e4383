#pragma once

#include <array>
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
  NoiseEstimates(const NoiseEstimate<2>& one, double warm_up, std::size_t count);

  /// The next samples of both signals, by element.
  void update(const std::array<std::vector<double>, 2>& samples) noexcept;

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
