#pragma once

#include <vector>

#include "estimator/mixed_power_spectrum.hpp"

namespace touchdown {

/// Power and median frequency of the window (clean + sigma · noise) for many sigmas, where the
/// median is that of the magnitude spectrum. The energy is a parabola in sigma; magnitudes take a
/// square root per bin and sigma.
class MixedMagnitudeSpectrum {
 public:
  /// For windows like `dft`'s; `nyquist` as in `SpectrumSummary`.
  MixedMagnitudeSpectrum(const SlidingDft& dft, bool nyquist);

  /// Prepare what is common to all sigmas for the newest window. Both must live until the last call
  /// of the operator.
  void update(const SlidingDft& clean, const SlidingDft& noise) noexcept;

  /// The same as `SpectrumSummary` up to rounding.
  [[nodiscard]] SpectrumValues operator()(double sigma) noexcept;

 private:
  static constexpr int lanes = SlidingDft::lanes;

  int window_;
  int rows_;
  bool nyquist_counts_;
  const SlidingDft* clean_ = nullptr;
  const SlidingDft* noise_ = nullptr;
  /// Coefficients of Σ |X + σZ|².
  double constant_ = 0.0;
  double linear_ = 0.0;
  double square_ = 0.0;
  std::vector<double> magnitude_;
  /// Row r: the sums of each lane's first r bins.
  std::vector<double> within_lane_;
};

}  // namespace touchdown
