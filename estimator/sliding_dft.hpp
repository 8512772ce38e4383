#pragma once

#include <vector>

namespace touchdown {

/// Discrete Fourier transform of the last N samples, kept up to date by one rotation per frequency
/// bin and sample instead of being computed anew:
///
///   X_k(t) = e^(2πik/N) · (X_k(t−1) + a_t − a_(t−N)),   k = 0 … ⌊N/2⌋,
///
/// which equals X_k = Σ_n a_(t−N+1+n) e^(−2πikn/N). In double precision the rotation's rounding
/// grows so slowly that nothing needs to be refreshed: below 1e-9 of the spectrum after 1e6 steps.
/// Samples must be finite. Starts from a window of zeros. No call but the constructor allocates.
class SlidingDft {
 public:
  /// Throws InputError unless window ≥ 2.
  explicit SlidingDft(int window);

  /// Back to a window of zeros.
  void reset() noexcept;

  /// Drop the oldest sample, take the newest.
  void push(double sample) noexcept;

  [[nodiscard]] int window() const noexcept { return static_cast<int>(samples_.size()); }
  /// Number of frequency bins, ⌊N/2⌋ + 1. Bin k stands for the frequency k · sample_rate / N.
  [[nodiscard]] int bins() const noexcept { return bins_; }
  [[nodiscard]] double real(int bin) const noexcept;
  [[nodiscard]] double imaginary(int bin) const noexcept;
  /// |X_k|² for k = 0 … bins() − 1, then zeros up to a multiple of `block_size`.
  [[nodiscard]] const std::vector<double>& squared_magnitudes() const noexcept { return squared_; }

  /// Bins are handled in groups of this many, for the compiler to use its vectors.
  static constexpr int block_size = 8;

 private:
  struct Block {
    double real[block_size] = {};
    double imaginary[block_size] = {};
    double cosine[block_size] = {};
    double sine[block_size] = {};
  };
  int bins_;
  std::vector<Block> blocks_;
  std::vector<double> squared_;
  std::vector<double> samples_;
  std::size_t oldest_ = 0;
};

}  // namespace touchdown
