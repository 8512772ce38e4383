#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
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
  std::vector<double> magnitudes_;
  /// Row r holds the sum of the first r bins of each lane.
  std::vector<double> within_simd_width_;
};

/// √x to one unit in the last place, for x = 0 and 1e-300 ≤ x ≤ 1e300; nearly 0 for smaller x. It
/// consists of multiplications and additions without a branch, so that loops over it become vector
/// code.
///
/// y ≈ 1/√x to 3.5 % by halving the exponent in the bits of x. With e = 1 − x y², the root is
/// x y (1 − e)^(−1/2) = x y (1 + e/2 + 3e²/8 + 5e³/16 + …). One step reaches 1e-6, with the last
/// two coefficients optimised for |e| < 0.07. A second step reaches full precision.
inline double square_root(double x) noexcept {
  const double rough =
      std::bit_cast<double>(0x5fe6eb50c7b537a9u - (std::bit_cast<std::uint64_t>(x) >> 1u));
  const double error = 1.0 - (x * rough) * rough;
  const double inverse = rough + rough * error * (0.5 + error * (0.37608 + error * 0.31347));
  const double root = x * inverse;
  const double rest = 1.0 - root * inverse;
  return root + root * rest * (0.5 + rest * 0.375);
}

/// Calls sink(i, √square(i)) for i < count. A processor computes roots in its divider, one vector
/// at a time, while its multipliers wait. Half of the roots here use multipliers instead, which
/// takes half of the time. `square` must not read what `sink` writes.
template <typename Square, typename Sink>
void square_roots(int count, const Square& square, const Sink& sink) noexcept {
  const int half = count / 8 * 4;
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC ivdep
#endif
  for (int i = 0; i < half; ++i) {
    sink(i, std::sqrt(square(i)));
    sink(half + i, square_root(square(half + i)));
  }
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC ivdep
#endif
  for (int i = 2 * half; i < count; ++i) sink(i, square_root(square(i)));
}

}  // namespace touchdown
