#include "estimator/spectrum_summary.hpp"

#include <cmath>

#include "estimator/spectral_median.hpp"
#include "estimator/square_root.hpp"

namespace touchdown {

SpectrumSummary::SpectrumSummary(const SlidingDft& dft, SpectrumKind kind, bool nyquist)
    : window_(dft.window()),
      rows_(dft.rows()),
      magnitude_(kind == SpectrumKind::magnitude),
      nyquist_counts_(nyquist),
      magnitudes_(dft.reals().size()),
      within_lane_(dft.reals().size() + SlidingDft::lanes) {}

template <typename Rows>
SpectrumValues SpectrumSummary::summarise(Rows rows, const SlidingDft& dft) noexcept {
  const double* const real = dft.reals().data();
  const double* const imaginary = dft.imaginaries().data();
  double* const within = within_lane_.data();
  const auto squared = [=](int row) -> SpectrumRow {
    return ConstSpectrumRowMap(real + row * lanes).square() +
           ConstSpectrumRowMap(imaginary + row * lanes).square();
  };
  SpectrumRow sum = cumulate(rows, squared, within);
  SpectrumValues values;
  values.mean_square = mean_square(sum.sum(), real[0], dft.nyquist(), window_);
  if (!(values.mean_square > negligible_mean_square)) {
    return values;
  }
  double nyquist = dft.nyquist() * dft.nyquist();
  if (magnitude_) {
    square_roots(
        rows * lanes, [=](int i) { return real[i] * real[i] + imaginary[i] * imaginary[i]; },
        [magnitudes = magnitudes_.data()](int i, double root) { magnitudes[i] = root; });
    const auto magnitude = [this](int row) {
      return ConstSpectrumRowMap(magnitudes_.data() + row * lanes);
    };
    sum = cumulate(rows, magnitude, within);
    nyquist = std::abs(dft.nyquist());
  }
  values.median_bin =
      median_bin(LaneSums::of(sum), nyquist_counts_ ? nyquist : 0.0, window_ / 2, rows, within);
  return values;
}

SpectrumValues SpectrumSummary::operator()(const SlidingDft& dft) noexcept {
  return with_rows(rows_, [&](auto rows) { return summarise(rows, dft); });
}

}  // namespace touchdown
