#include "estimator/mixed_magnitude_spectrum.hpp"

#include <cmath>

#include "estimator/square_root.hpp"

namespace touchdown {

MixedMagnitudeSpectrum::MixedMagnitudeSpectrum(const SlidingDft& dft, bool nyquist)
    : window_(dft.window()),
      rows_(dft.rows()),
      nyquist_counts_(nyquist),
      magnitude_(dft.reals().size()),
      within_lane_(dft.reals().size() + lanes) {}

void MixedMagnitudeSpectrum::update(const SlidingDft& clean, const SlidingDft& noise) noexcept {
  clean_ = &clean;
  noise_ = &noise;
  SpectrumRow constant = SpectrumRow::Zero();
  SpectrumRow linear = SpectrumRow::Zero();
  SpectrumRow square = SpectrumRow::Zero();
  for (int row = 0; row < rows_; ++row) {
    const ConstSpectrumRowMap x(clean.reals().data() + row * lanes);
    const ConstSpectrumRowMap y(clean.imaginaries().data() + row * lanes);
    const ConstSpectrumRowMap x_noise(noise.reals().data() + row * lanes);
    const ConstSpectrumRowMap y_noise(noise.imaginaries().data() + row * lanes);
    constant += x.square() + y.square();
    linear += 2.0 * (x * x_noise + y * y_noise);
    square += x_noise.square() + y_noise.square();
  }
  constant_ = constant.sum();
  linear_ = linear.sum();
  square_ = square.sum();
}

SpectrumValues MixedMagnitudeSpectrum::operator()(double sigma) noexcept {
  const double* const x = clean_->reals().data();
  const double* const y = clean_->imaginaries().data();
  const double* const x_noise = noise_->reals().data();
  const double* const y_noise = noise_->imaginaries().data();
  const MixedRealBin mean{x[0], x_noise[0]};
  const MixedRealBin nyquist{clean_->nyquist(), noise_->nyquist()};
  SpectrumValues values;
  values.mean_square = mean_square(constant_ + sigma * (linear_ + sigma * square_), mean.at(sigma),
                                   nyquist.at(sigma), window_);
  if (!(values.mean_square > negligible_mean_square)) {
    return values;
  }
  values.median_bin = with_rows(rows_, [&](auto rows) {
    square_roots(
        rows * lanes,
        [=](int i) {
          const double real = x[i] + sigma * x_noise[i];
          const double imaginary = y[i] + sigma * y_noise[i];
          return real * real + imaginary * imaginary;
        },
        magnitude_.data());
    const auto magnitude = [this](int row) {
      return ConstSpectrumRowMap(magnitude_.data() + row * lanes);
    };
    const SpectrumRow sum = cumulate(rows, magnitude, within_lane_.data());
    return median_bin(LaneSums::of(sum), nyquist_counts_ ? std::abs(nyquist.at(sigma)) : 0.0,
                      window_ / 2, rows, within_lane_.data());
  });
  return values;
}

}  // namespace touchdown
