#include "estimator/spectrum_summary.hpp"

#include <cmath>

namespace touchdown {
namespace {

constexpr int block_size = SlidingDft::block_size;
constexpr double negligible_rms = 1e-9;

/// A tree instead of a chain, so that the additions do not wait for each other.
double sum_of_block(const double* x) noexcept {
  static_assert(block_size == 8);
  return ((x[0] + x[4]) + (x[1] + x[5])) + ((x[2] + x[6]) + (x[3] + x[7]));
}

}  // namespace

SpectrumSummary::SpectrumSummary(const SlidingDft& dft, SpectrumKind kind, bool nyquist)
    : window_(dft.window()),
      magnitude_(kind == SpectrumKind::magnitude),
      nyquist_bin_(dft.window() % 2 == 0 ? dft.window() / 2 : -1),
      nyquist_counts_(nyquist),
      weights_(dft.squared_magnitudes().size()),
      block_sums_(dft.squared_magnitudes().size() / block_size) {}

SpectrumValues SpectrumSummary::operator()(const SlidingDft& dft) noexcept {
  const double* squared = dft.squared_magnitudes().data();
  const std::size_t blocks = block_sums_.size();
  const double n = window_;

  double energy = 0.0;
  for (std::size_t b = 0; b < blocks; ++b) {
    block_sums_[b] = sum_of_block(squared + b * block_size);
    energy += block_sums_[b];
  }
  // Bins that stand for two frequencies, +ω and −ω, count twice.
  const double unpaired = squared[0] + (nyquist_bin_ >= 0 ? squared[nyquist_bin_] : 0.0);
  SpectrumValues values;
  values.mean_square = (2.0 * energy - unpaired) / (n * n);
  if (!(values.mean_square > negligible_rms * negligible_rms)) {
    return values;
  }

  const double* weights = squared;
  double total = energy;
  if (magnitude_) {
    for (std::size_t k = 0; k < weights_.size(); ++k) {
      weights_[k] = std::sqrt(squared[k]);
    }
    weights = weights_.data();
    total = 0.0;
    for (std::size_t b = 0; b < blocks; ++b) {
      block_sums_[b] = sum_of_block(weights + b * block_size);
      total += block_sums_[b];
    }
  }
  if (!nyquist_counts_ && nyquist_bin_ >= 0) {
    total -= weights[nyquist_bin_];
  }

  const double half = 0.5 * total;
  double below = 0.0;
  std::size_t block = 0;
  while (block + 1 < blocks && below + block_sums_[block] < half) {
    below += block_sums_[block];
    ++block;
  }
  std::size_t bin = block * block_size;
  const std::size_t last = weights_.size() - 1;
  while (bin < last && below + weights[bin] < half) {
    below += weights[bin];
    ++bin;
  }
  if (bin > 0 && weights[bin] > 0.0) {
    values.median_bin = static_cast<double>(bin - 1) + (half - below) / weights[bin];
  }
  return values;
}

}  // namespace touchdown
