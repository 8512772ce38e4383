#pragma once

#include <vector>

#include "estimator/sliding_dft.hpp"

namespace touchdown {

/// Which spectrum the median frequency splits into two halves.
enum class SpectrumKind : int {
  power,      ///< |X_k|², as in the paper
  magnitude,  ///< |X_k|, as in the authors' code
};

/// What the transition model needs to know of a spectrum.
struct SpectrumValues {
  /// Mean of the squared samples of the window, which by Parseval's theorem is also the mean over
  /// all N frequency bins of A_t(ω) = |â_t(ω)|²/N, Eq. (10) of the paper (unit² of the samples).
  double mean_square = 0.0;
  /// ω_median, Eq. (12), in bins (multiply by sample_rate / N for Hz).
  double median_bin = 0.0;
};

/// Summarises the spectrum of a sliding window. The median is where the cumulative sum over the
/// bins 0 … ⌊N/2⌋ reaches half of its end, interpolated linearly between bins; it is 0 if bin 0
/// holds half or more, or if the window holds no more than rounding errors (an RMS below 1e-9).
class SpectrumSummary {
 public:
  /// RMS of a window below which its spectrum counts as empty.
  static constexpr double negligible_rms = 1e-9;

  /// With `nyquist` false an even window's last bin, N/2, is left out of the median.
  SpectrumSummary(const SlidingDft& dft, SpectrumKind kind, bool nyquist);

  /// `dft` must have the window that was given to the constructor.
  [[nodiscard]] SpectrumValues operator()(const SlidingDft& dft) noexcept;

  /// The same for the window (clean + sigma · noise), from the spectra of both: the transform is
  /// linear, so that one pair of transforms serves every sigma.
  [[nodiscard]] SpectrumValues operator()(const SlidingDft& clean, const SlidingDft& noise,
                                          double sigma) noexcept;

 private:
  struct Weights {
    double lane[SlidingDft::lanes] = {};
  };
  template <typename SquaredRow>
  SpectrumValues summarise(const SquaredRow& squared_row) noexcept;

  int window_;
  int bins_;
  bool magnitude_;
  /// Bin of an even window's Nyquist frequency, or −1.
  int nyquist_bin_;
  bool nyquist_counts_;
  std::vector<Weights> weights_;
};

}  // namespace touchdown
