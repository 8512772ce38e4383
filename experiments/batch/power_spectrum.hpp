#pragma once

#include <span>
#include <vector>

#include "estimator/spectrum/median.hpp"
#include "estimator/spectrum/summary.hpp"
#include "experiments/batch/bins.hpp"

namespace touchdown::experiments {

/// Power and median frequency of the window (clean + sigma · noise) for many sigmas, cheaper than
/// one spectrum each: |X + σZ|² = |X|² + σ · 2 Re(X·Z̄) + σ² |Z|². Every cumulative sum over bins is
/// thereby a parabola in σ, and all sigmas share the three sums of its coefficients. The search for
/// a median evaluates sixteen parabolas instead of all bins. This works for the power spectrum
/// only, not for magnitudes.
class MixedPowerSpectrum {
 public:
  /// Uses the window of `dft`; `nyquist` as in `SpectrumSummary`.
  MixedPowerSpectrum(const SlidingDft& dft, bool nyquist);

  /// Computes one value per sigma, equal to that of `SpectrumSummary` up to rounding.
  void summarise(const SlidingDft& clean, const SlidingDft& noise, std::span<const double> sigmas,
                 std::span<SpectrumValues> values) noexcept;

 private:
  static constexpr int lanes = SlidingDft::lanes;

  /// Computes the sums that all sigmas share.
  void cumulate(const SlidingDft& clean, const SlidingDft& noise) noexcept;
  [[nodiscard]] SpectrumValues at(double sigma) const noexcept;
  template <typename Rows>
  [[nodiscard]] double median(Rows rows, const SimdSums& sums, double nyquist,
                              double sigma) const noexcept;

  int window_;
  int rows_;
  bool nyquist_counts_;
  /// Row r: the sums of the first r bins of each SIMD lane, one array per coefficient.
  std::vector<double> within_lanes_;
  SimdSums constant_{};
  SimdSums linear_{};
  SimdSums square_{};
  MixedRealBin mean_;
  MixedRealBin nyquist_;
};

}  // namespace touchdown::experiments
