#include "estimator/mixed_power_spectrum.hpp"

#include <algorithm>
#include <cstdint>

namespace touchdown {

MixedPowerSpectrum::MixedPowerSpectrum(const SlidingDft& dft, bool nyquist)
    : window_(dft.window()),
      bins_(dft.bins()),
      even_(dft.window() % 2 == 0),
      nyquist_counts_(nyquist),
      bin_(static_cast<std::size_t>(dft.rows())),
      within_lane_(bin_.size()) {}

void MixedPowerSpectrum::update(const SlidingDft& clean, const SlidingDft& noise) noexcept {
  Parabolas sum;
  for (std::size_t r = 0; r < bin_.size(); ++r) {
    const SlidingDft::Row& x = clean.row(static_cast<int>(r));
    const SlidingDft::Row& z = noise.row(static_cast<int>(r));
    Parabolas& bin = bin_[r];
    for (int i = 0; i < lanes; ++i) {
      bin.constant[i] = x.squared[i];
      bin.linear[i] = 2.0 * (x.real[i] * z.real[i] + x.imaginary[i] * z.imaginary[i]);
      bin.square[i] = z.squared[i];
      sum.constant[i] += bin.constant[i];
      sum.linear[i] += bin.linear[i];
      sum.square[i] += bin.square[i];
    }
    within_lane_[r] = sum;
  }
  for (int i = 1; i < lanes; ++i) {
    sum.constant[i] += sum.constant[i - 1];
    sum.linear[i] += sum.linear[i - 1];
    sum.square[i] += sum.square[i - 1];
  }
  up_to_lane_ = sum;
}

SpectrumValues MixedPowerSpectrum::operator()(double sigma) const noexcept {
  const auto rows = static_cast<int>(bin_.size());
  const double n = window_;
  const double energy = up_to_lane_.at(lanes - 1, sigma);
  const double last =
      even_ ? bin_[static_cast<std::size_t>((bins_ - 1) % rows)].at((bins_ - 1) / rows, sigma)
            : 0.0;
  SpectrumValues values;
  values.mean_square = (2.0 * energy - bin_.front().at(0, sigma) - last) / (n * n);
  if (!(values.mean_square > SpectrumSummary::negligible_rms * SpectrumSummary::negligible_rms)) {
    return values;
  }

  const double half = 0.5 * (nyquist_counts_ ? energy : energy - last);
  // Counters as wide as the sums, so that eight comparisons are two vectors. The last lane's sum is
  // the whole, never less than its half.
  std::int64_t passed_lanes = 0;
  for (int i = 0; i < lanes; ++i) {
    passed_lanes += up_to_lane_.at(i, sigma) < half ? 1 : 0;
  }
  const int lane = std::min(lanes - 1, static_cast<int>(passed_lanes));
  const double before = lane > 0 ? up_to_lane_.at(lane - 1, sigma) : 0.0;
  const double remaining = half - before;
  int row = 0;
  for (int r = 0; r < rows - 1; ++r) {
    row += within_lane_[static_cast<std::size_t>(r)].at(lane, sigma) < remaining ? 1 : 0;
  }
  const double below =
      row > 0 ? within_lane_[static_cast<std::size_t>(row - 1)].at(lane, sigma) : 0.0;
  const int bin = lane * rows + row;
  const double inside = bin_[static_cast<std::size_t>(row)].at(lane, sigma);
  if (bin > 0 && inside > 0.0) {
    values.median_bin = (bin - 1) + std::min(1.0, (remaining - below) / inside);
  }
  return values;
}

}  // namespace touchdown
