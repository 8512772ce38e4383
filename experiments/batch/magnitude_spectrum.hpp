#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "estimator/spectrum/summary.hpp"
#include "experiments/batch/bins.hpp"

namespace touchdown::experiments {

/// Power, and median frequency of the magnitude spectrum, of the window (clean + sigma · noise) for
/// many sigmas. The energy is a parabola in sigma. Magnitudes take a square root per bin and sigma,
/// so the loops are vectorised over sigmas.
class MixedMagnitudeSpectrum {
 public:
  /// Uses the window of `dft`; `nyquist` as in `SpectrumSummary`.
  MixedMagnitudeSpectrum(const SlidingDft& dft, bool nyquist);

  /// Computes one value per sigma, equal to that of `SpectrumSummary` up to rounding.
  void summarise(const SlidingDft& clean, const SlidingDft& noise, std::span<const double> sigmas,
                 std::span<SpectrumValues> values) noexcept;

 private:
  /// Largest number of sigmas per block: their sums fit into the fastest cache.
  static constexpr int most = 64;

  void set_energies(const SlidingDft& clean, const SlidingDft& noise) noexcept;
  void cumulate(const SlidingDft& clean, const SlidingDft& noise) noexcept;
  template <typename Rows>
  void set_medians(Rows rows, MixedRealBin nyquist, std::span<SpectrumValues> values) noexcept;

  int window_;
  int rows_;
  bool nyquist_counts_;
  /// Coefficients of Σ |X + σZ|².
  double constant_ = 0.0;
  double linear_ = 0.0;
  double square_ = 0.0;
  /// Sigmas of the current block, padded to whole vectors.
  int width_ = 0;
  std::vector<double> sigma_;
  /// Half of each spectrum's sum, and the number of lanes with a cumulative sum below it.
  std::vector<double> half_;
  std::vector<std::int64_t> passed_;
  /// Row k: the sums of the first k bins, one per sigma.
  std::vector<double> sum_;
};

}  // namespace touchdown::experiments
