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

}  // namespace touchdown
