#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace touchdown {

/// Discrete Fourier transform of the last N samples, kept up to date by one rotation per frequency
/// bin and sample instead of being computed anew:
///
///   X_k(t) = e^(2πik/N) · (X_k(t−1) + a_t − a_(t−N)),   k = 0 … ⌊N/2⌋,
///
/// which equals X_k = Σ_n a_(t−N+1+n) e^(−2πikn/N). In double precision the rotation's rounding
/// errors stay below 1e-9 of the spectrum after 1e6 steps, so the transform needs no refresh.
/// Samples must be finite. The window starts with zeros. Only the constructor allocates.
class SlidingDft {
 public:
  /// Throws InputError unless window ≥ 2.
  explicit SlidingDft(int window);

  /// Back to a window of zeros.
  void reset() noexcept;

  /// Replaces the oldest sample by the newest.
  void push(double sample) noexcept;

  [[nodiscard]] int window() const noexcept { return static_cast<int>(samples_.size()); }
  /// Number of frequency bins, ⌊N/2⌋ + 1. Bin k has the frequency k · sample_rate / N.
  [[nodiscard]] int bins() const noexcept { return bins_; }
  [[nodiscard]] double real(int bin) const noexcept;
  [[nodiscard]] double imaginary(int bin) const noexcept;
  /// |X_k|².
  [[nodiscard]] double squared_magnitude(int bin) const noexcept;

  /// SIMD layout: vector code processes `lanes` bins at once, and each lane holds `rows()`
  /// neighbouring bins. Bin k is in lane k / rows(), row k % rows(). A sum over rows thus gives the
  /// sums over `lanes` contiguous parts of the spectrum.
  static constexpr int lanes = 8;
  [[nodiscard]] int rows() const noexcept { return rows_; }
  /// Real and imaginary parts of all bins below the Nyquist frequency, row after row. Padding
  /// beyond the last bin is zero.
  [[nodiscard]] std::span<const double> reals() const noexcept { return real_; }
  [[nodiscard]] std::span<const double> imaginaries() const noexcept { return imaginary_; }
  /// X_(N/2) of an even window, which is real. It is in no row, because 64 bins fill vectors and 65
  /// do not. 0 for an odd window, which has no such bin.
  [[nodiscard]] double nyquist() const noexcept { return nyquist_; }

 private:
  [[nodiscard]] std::size_t place(int bin) const noexcept {
    return static_cast<std::size_t>(bin % rows_ * lanes + bin / rows_);
  }

  int bins_;
  int rows_ = 0;
  /// e^(πi), or 0 without a Nyquist bin.
  double nyquist_turn_;
  double nyquist_ = 0.0;
  std::vector<double> real_;
  std::vector<double> imaginary_;
  /// e^(2πik/N).
  std::vector<double> cosine_;
  std::vector<double> sine_;
  std::vector<double> samples_;
  std::size_t oldest_ = 0;
};

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
  /// Row r holds the sum of the first r bins of each lane.
  std::vector<double> within_simd_width_;
};

}  // namespace touchdown
