#pragma once

#include <vector>

#include "estimator/numerics/sliding_dft.hpp"

namespace touchdown {

/// Which spectrum the median frequency splits into two halves.
enum class SpectrumKind : int {
  power,      ///< |X_k|², as in the paper
  magnitude,  ///< |X_k|, as in the authors' code
};

/// The two numbers that the transition model uses of a spectrum.
struct SpectrumValues {
  /// Mean of the squared samples of the window, which by Parseval's theorem is also the mean over
  /// all N frequency bins of A_t(ω) = |â_t(ω)|²/N, Eq. (10) of the paper (unit² of the samples).
  double mean_square = 0.0;
  /// ω_median, Eq. (12), in bins (multiply by sample_rate / N for Hz).
  double median_bin = 0.0;
};

/// Mean square of a window below which its spectrum counts as empty.
inline constexpr double negligible_mean_square = 1e-18;

/// Parseval's theorem for real samples: `below_nyquist` is Σ |X_k|² over the bins k < N/2. All but
/// the first and the last bin, which are real, stand for two frequencies, +ω and −ω.
inline double mean_square(double below_nyquist, double first, double nyquist, double n) noexcept {
  return (2.0 * below_nyquist - first * first + nyquist * nyquist) / (n * n);
}

/// Summarises the spectrum of a sliding window. The median is where the cumulative sum over the
/// bins 0 … ⌊N/2⌋ reaches half of the total, interpolated linearly between bins. It is 0 if bin 0
/// holds half or more, or if the window holds only rounding errors (an RMS below 1e-9).
class SpectrumSummary {
 public:
  /// If `nyquist` is false, the median leaves out an even window's last bin, N/2.
  SpectrumSummary(const SlidingDft& dft, SpectrumKind kind, bool nyquist);

  /// `dft` must have the window that was given to the constructor.
  [[nodiscard]] SpectrumValues operator()(const SlidingDft& dft) noexcept;

 private:
  static constexpr int lanes = SlidingDft::lanes;
  template <typename Rows>
  SpectrumValues of_power(Rows rows, const SlidingDft& dft) noexcept;
  template <typename Rows>
  SpectrumValues of_magnitude(Rows rows, const SlidingDft& dft) noexcept;

  int window_;
  int rows_;
  bool magnitude_;
  bool nyquist_counts_;
  std::vector<double> magnitudes_;
  /// Row r holds the sum of the first r bins of each lane.
  std::vector<double> within_simd_width_;
};

}  // namespace touchdown
