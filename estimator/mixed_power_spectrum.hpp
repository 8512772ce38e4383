#pragma once

#include <vector>

#include "estimator/spectrum_summary.hpp"

namespace touchdown {

/// Power and median frequency of the window (clean + sigma · noise) for many sigmas, cheaper than
/// one spectrum each: |X + σZ|² = |X|² + σ · 2 Re(X·Z̄) + σ² |Z|², so every cumulative sum over bins
/// is a parabola in σ, and the three sums that make its coefficients are common to all sigmas. A
/// median is then found with sixteen parabolas instead of all bins. Power spectrum only: magnitudes
/// do not add up like that.
class MixedPowerSpectrum {
 public:
  /// For windows like `dft`'s; `nyquist` as in `SpectrumSummary`.
  MixedPowerSpectrum(const SlidingDft& dft, bool nyquist);

  /// Prepare the common sums for the newest window.
  void update(const SlidingDft& clean, const SlidingDft& noise) noexcept;

  /// The same as `SpectrumSummary` up to rounding.
  [[nodiscard]] SpectrumValues operator()(double sigma) const noexcept;

 private:
  static constexpr int lanes = SlidingDft::lanes;
  struct Parabolas {
    double constant[lanes] = {};
    double linear[lanes] = {};
    double square[lanes] = {};

    [[nodiscard]] double at(int lane, double sigma) const noexcept {
      return constant[lane] + sigma * (linear[lane] + sigma * square[lane]);
    }
  };
  int window_;
  int bins_;
  bool even_;
  bool nyquist_counts_;
  std::vector<Parabolas> bin_;
  /// Sums over the rows of a lane, up to and with a row.
  std::vector<Parabolas> within_lane_;
  /// Sums over all lanes up to and with a lane.
  Parabolas up_to_lane_;
};

}  // namespace touchdown
