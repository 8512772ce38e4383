#include "experiments/batch/power_spectrum.hpp"

#include <algorithm>

namespace touchdown::experiments {

MixedPowerSpectrum::MixedPowerSpectrum(const SlidingDft& dft, bool nyquist)
    : window_(dft.window()),
      rows_(dft.rows()),
      nyquist_counts_(nyquist),
      within_lanes_(3 * (dft.reals().size() + lanes)) {}

void MixedPowerSpectrum::summarise(const SlidingDft& clean, const SlidingDft& noise,
                                   std::span<const double> sigmas,
                                   std::span<SpectrumValues> values) noexcept {
  cumulate(clean, noise);
  for (std::size_t i = 0; i < sigmas.size(); ++i) values[i] = at(sigmas[i]);
}

void MixedPowerSpectrum::cumulate(const SlidingDft& clean, const SlidingDft& noise) noexcept {
  MixedEnergy energy;
  for (int row = 0; row < rows_; ++row) {
    energy.add_row(clean, noise, row);
    double* const sums = within_lanes_.data() + 3 * (row + 1) * lanes;
    SpectrumRowMap{sums} = energy.constant;
    SpectrumRowMap{sums + lanes} = energy.linear;
    SpectrumRowMap{sums + 2 * lanes} = energy.square;
  }
  constant_ = SimdSums::of(energy.constant);
  linear_ = SimdSums::of(energy.linear);
  square_ = SimdSums::of(energy.square);
  mean_ = {clean.real(0), noise.real(0)};
  nyquist_ = {clean.nyquist(), noise.nyquist()};
}

template <typename Rows>
double MixedPowerSpectrum::median(Rows rows, const SimdSums& sums, double nyquist,
                                  double sigma) const noexcept {
  const double half = 0.5 * (sums.total() + nyquist);
  if (sums.total() < half) return 0.5 * window_ - 1.0 + (half - sums.total()) / nyquist;
  const auto within = [this, sigma](int row, int lane) {
    const double* const parabola = within_lanes_.data() + 3 * row * lanes + lane;
    return parabola[0] + sigma * (parabola[lanes] + sigma * parabola[2 * lanes]);
  };
  const int lane = count_below(half, lanes, [&](int i) { return sums.before[i]; });
  const double rest = half - sums.before[lane];
  const int row = count_below(rest, rows, [&](int r) { return within(r, lane); });
  const double below = within(row, lane);
  const double inside = within(row + 1, lane) - below;
  const int bin = lane * rows + row;
  if (bin == 0 || !(inside > 0.0)) return 0.0;
  return (bin - 1) + std::min(1.0, (rest - below) / inside);
}

SpectrumValues MixedPowerSpectrum::at(double sigma) const noexcept {
  SimdSums sums;
  for (int i = 0; i <= lanes; ++i) {
    sums.before[i] = constant_.before[i] + sigma * (linear_.before[i] + sigma * square_.before[i]);
  }
  const double nyquist = nyquist_.at(sigma);
  SpectrumValues values;
  values.mean_square = mean_square(sums.total(), mean_.at(sigma), nyquist, window_);
  if (values.mean_square > negligible_mean_square) {
    values.median_bin = with_rows(rows_, [&](auto rows) {
      return median(rows, sums, nyquist_counts_ ? nyquist * nyquist : 0.0, sigma);
    });
  }
  return values;
}

}  // namespace touchdown::experiments
