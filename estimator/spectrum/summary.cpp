#include "estimator/spectrum/summary.hpp"

#include <cmath>

#include "estimator/numerics/square_root.hpp"
#include "estimator/spectrum/median.hpp"

namespace touchdown {
namespace {

/// |X|², row by row.
auto squared_magnitudes(const SlidingDft& dft) noexcept {
  return [real = dft.reals().data(), imaginary = dft.imaginaries().data()](int row) -> SpectrumRow {
    return ConstSpectrumRowMap(real + row * SlidingDft::lanes).square() +
           ConstSpectrumRowMap(imaginary + row * SlidingDft::lanes).square();
  };
}

}  // namespace

SpectrumSummary::SpectrumSummary(const SlidingDft& dft, SpectrumKind kind, bool nyquist)
    : window_(dft.window()),
      rows_(dft.rows()),
      magnitude_(kind == SpectrumKind::magnitude),
      nyquist_counts_(nyquist),
      magnitudes_(dft.reals().size()),
      within_simd_width_(dft.reals().size() + SlidingDft::lanes) {}

template <typename Rows>
SpectrumValues SpectrumSummary::of_power(Rows rows, const SlidingDft& dft) noexcept {
  const double nyquist = dft.nyquist();
  double* const within = within_simd_width_.data();
  const SpectrumRow sum = cumulate(rows, squared_magnitudes(dft), within);
  SpectrumValues values;
  values.mean_square = mean_square(sum.sum(), dft.reals()[0], nyquist, window_);
  if (values.mean_square > negligible_mean_square) {
    const double last = nyquist_counts_ ? nyquist * nyquist : 0.0;
    values.median_bin = median_bin(SimdSums::of(sum), last, window_ / 2, rows, within);
  }
  return values;
}

template <typename Rows>
SpectrumValues SpectrumSummary::of_magnitude(Rows rows, const SlidingDft& dft) noexcept {
  const double nyquist = dft.nyquist();
  const double* const real = dft.reals().data();
  const double* const imaginary = dft.imaginaries().data();
  double* const magnitude = magnitudes_.data();
  double* const within = within_simd_width_.data();
  square_roots(
      rows * lanes, [=](int i) { return real[i] * real[i] + imaginary[i] * imaginary[i]; },
      [=](int i, double root) { magnitude[i] = root; });
  const auto squared = squared_magnitudes(dft);
  SpectrumRow energy = SpectrumRow::Zero();
  for (int row = 0; row < rows; ++row) energy += squared(row);
  SpectrumValues values;
  values.mean_square = mean_square(energy.sum(), real[0], nyquist, window_);
  if (values.mean_square > negligible_mean_square) {
    const double last = nyquist_counts_ ? std::abs(nyquist) : 0.0;
    const auto row_of = [=](int row) { return ConstSpectrumRowMap(magnitude + row * lanes); };
    const SpectrumRow sum = cumulate(rows, row_of, within);
    values.median_bin = median_bin(SimdSums::of(sum), last, window_ / 2, rows, within);
  }
  return values;
}

SpectrumValues SpectrumSummary::operator()(const SlidingDft& dft) noexcept {
  return with_rows(
      rows_, [&](auto rows) { return magnitude_ ? of_magnitude(rows, dft) : of_power(rows, dft); });
}

}  // namespace touchdown
