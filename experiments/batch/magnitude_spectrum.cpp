#include "experiments/batch/magnitude_spectrum.hpp"

#include <algorithm>
#include <cmath>

#include "estimator/numerics/square_root.hpp"

namespace touchdown::experiments {
namespace {

constexpr int lanes = SlidingDft::lanes;

}  // namespace

MixedMagnitudeSpectrum::MixedMagnitudeSpectrum(const SlidingDft& dft, bool nyquist)
    : window_(dft.window()),
      rows_(dft.rows()),
      nyquist_counts_(nyquist),
      sigma_(most),
      half_(most),
      passed_(most),
      sum_((dft.reals().size() + 1) * most) {}

void MixedMagnitudeSpectrum::summarise(const SlidingDft& clean, const SlidingDft& noise,
                                       std::span<const double> sigmas,
                                       std::span<SpectrumValues> values) noexcept {
  set_energies(clean, noise);
  const MixedRealBin mean{clean.real(0), noise.real(0)};
  const MixedRealBin nyquist{clean.nyquist(), noise.nyquist()};
  for (std::size_t i = 0; i < sigmas.size(); ++i) {
    const double sigma = sigmas[i];
    values[i] = {mean_square(constant_ + sigma * (linear_ + sigma * square_), mean.at(sigma),
                             nyquist.at(sigma), window_),
                 0.0};
  }
  for (std::size_t first = 0; first < sigmas.size(); first += most) {
    const std::size_t count = std::min<std::size_t>(most, sigmas.size() - first);
    std::copy_n(sigmas.begin() + static_cast<std::ptrdiff_t>(first), count, sigma_.begin());
    width_ = static_cast<int>((count + 3) / 4 * 4);
    cumulate(clean, noise);
    with_rows(rows_, [&](auto rows) { set_medians(rows, nyquist, values.subspan(first, count)); });
  }
}

void MixedMagnitudeSpectrum::set_energies(const SlidingDft& clean,
                                          const SlidingDft& noise) noexcept {
  MixedEnergy energy;
  for (int row = 0; row < rows_; ++row) energy.add_row(clean, noise, row);
  constant_ = energy.constant.sum();
  linear_ = energy.linear.sum();
  square_ = energy.square.sum();
}

void MixedMagnitudeSpectrum::cumulate(const SlidingDft& clean, const SlidingDft& noise) noexcept {
  const int width = width_;
  const double* const sigma = sigma_.data();
  double* sum = sum_.data();
  std::fill_n(sum, width, 0.0);
  for (int lane = 0; lane < lanes; ++lane) {
    for (int row = 0; row < rows_; ++row) {
      const auto bin = static_cast<std::size_t>(row * lanes + lane);
      const MixedRealBin real{clean.reals()[bin], noise.reals()[bin]};
      const MixedRealBin imaginary{clean.imaginaries()[bin], noise.imaginaries()[bin]};
      square_roots(
          width,
          [=](int i) {
            const double x = real.at(sigma[i]);
            const double y = imaginary.at(sigma[i]);
            return x * x + y * y;
          },
          [=](int i, double magnitude) { sum[width + i] = sum[i] + magnitude; });
      sum += width;
    }
  }
}

template <typename Rows>
void MixedMagnitudeSpectrum::set_medians(Rows rows, MixedRealBin nyquist,
                                         std::span<SpectrumValues> values) noexcept {
  const int bins = rows * lanes;
  const int width = width_;
  const double* const sum = sum_.data();
  const double* const total = sum + bins * width;
  const double* const sigma = sigma_.data();
  double* const half = half_.data();
  std::int64_t* const passed = passed_.data();
  const double counts = nyquist_counts_ ? 1.0 : 0.0;
  // The arrays do not overlap, which the compiler cannot know.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC ivdep
#endif
  for (int i = 0; i < width; ++i) {
    half[i] = 0.5 * (total[i] + counts * std::abs(nyquist.at(sigma[i])));
    std::int64_t lane = 0;
    for (int end = 1; end <= lanes; ++end) lane += sum[end * rows * width + i] < half[i] ? 1 : 0;
    passed[i] = lane;
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!(values[i].mean_square > negligible_mean_square)) continue;
    if (passed[i] == lanes) {  // in the Nyquist bin
      values[i].median_bin =
          0.5 * window_ - 1.0 + (half[i] - total[i]) / std::abs(nyquist.at(sigma[i]));
      continue;
    }
    const int first = static_cast<int>(passed[i]) * rows;
    const int row = count_below(
        half[i], rows, [=](int r) { return sum[(first + r) * width + static_cast<int>(i)]; });
    const int bin = first + row;
    const double* const below = sum + bin * width + i;
    const double inside = below[width] - below[0];
    if (bin > 0 && inside > 0.0) {
      values[i].median_bin = (bin - 1) + std::min(1.0, (half[i] - below[0]) / inside);
    }
  }
}

}  // namespace touchdown::experiments
