#pragma once

#include <span>
#include <vector>

#include "estimator/spectrum/median.hpp"
#include "estimator/spectrum/summary.hpp"
#include "experiments/batch/bins.hpp"

namespace touchdown::experiments {

/// Power and median frequency of the window (clean + sigma · noise) for many sigmas, cheaper than
/// one spectrum each: |X + σZ|² = |X|² + σ · 2 Re(X·Z̄) + σ² |Z|², so every cumulative sum over bins
/// is a parabola in σ, and the three sums that make its coefficients are common to all sigmas. A
/// median is then found with sixteen parabolas instead of all bins. Power spectrum only: magnitudes
/// do not add up like that.
class MixedPowerSpectrum {
 public:
  /// For windows like `dft`'s; `nyquist` as in `SpectrumSummary`.
  MixedPowerSpectrum(const SlidingDft& dft, bool nyquist);

  /// One value per sigma, the same as those of `SpectrumSummary` up to rounding.
  void summarise(const SlidingDft& clean, const SlidingDft& noise, std::span<const double> sigmas,
                 std::span<SpectrumValues> values) noexcept;

 private:
  static constexpr int lanes = SlidingDft::lanes;

  /// Make the sums that are common to all sigmas.
  void cumulate(const SlidingDft& clean, const SlidingDft& noise) noexcept;
  [[nodiscard]] SpectrumValues at(double sigma) const noexcept;
  template <typename Rows>
  [[nodiscard]] double median(Rows rows, const SimdSums& sums, double nyquist,
                              double sigma) const noexcept;

  int window_;
  int rows_;
  bool nyquist_counts_;
  /// Row r: the sums of each lane's first r bins, one array for each of the three coefficients.
  std::vector<double> within_simd_width_;
  SimdSums constant_{};
  SimdSums linear_{};
  SimdSums square_{};
  MixedRealBin mean_;
  MixedRealBin nyquist_;
};

}  // namespace touchdown::experiments
