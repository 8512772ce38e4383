#include "estimator/numerics/sliding_dft.hpp"

#include <algorithm>
#include <numbers>
#include <string>
#include <type_traits>

#include <Eigen/Core>

#include "core/error.hpp"

namespace touchdown {

namespace {

/// One row of a spectrum in the layout of `SlidingDft`.
using SpectrumRow = Eigen::Array<double, SlidingDft::lanes, 1>;
using SpectrumRowMap = Eigen::Map<SpectrumRow>;
using ConstSpectrumRowMap = Eigen::Map<const SpectrumRow>;

/// Cumulative sums over whole lanes: before[i] is the sum of the lanes 0 … i − 1. The last one is
/// the sum of all bins below the Nyquist frequency.
struct SimdSums {
  static constexpr int lanes = SlidingDft::lanes;

  double before[lanes + 1];

  /// From the sum of each lane. A tree of additions is faster than a chain.
  static SimdSums of(const SpectrumRow& lane) noexcept {
    static_assert(lanes == 8);
    const double s01 = lane[0] + lane[1];
    const double s23 = lane[2] + lane[3];
    const double s45 = lane[4] + lane[5];
    const double s67 = lane[6] + lane[7];
    const double s0123 = s01 + s23;
    const double s012345 = s0123 + s45;
    return {{0.0, lane[0], s01, s01 + lane[2], s0123, s0123 + lane[4], s012345, s012345 + lane[6],
             s0123 + (s45 + s67)}};
  }
  [[nodiscard]] double total() const noexcept { return before[lanes]; }
};

/// Calls f(rows). For the usual window of 128 samples, `rows` is a constant, so the compiler can
/// unroll loops.
template <typename Function>
auto with_rows(int rows, const Function& f) noexcept {
  constexpr std::integral_constant<int, 128 / 2 / SlidingDft::lanes> usual;
  return rows == usual ? f(usual) : f(rows);
}

/// Cumulative sums over rows, for each lane: row r of `within` becomes the sum of the rows 0 … r
/// − 1. Returns the sum of all rows.
template <typename Rows, typename RowOf>
SpectrumRow cumulate(Rows rows, const RowOf& row_of, double* within) noexcept {
  SpectrumRow sum = SpectrumRow::Zero();
  for (int row = 0; row < rows; ++row) {
    sum += row_of(row);
    SpectrumRowMap{within + (row + 1)* SlidingDft::lanes} = sum;
  }
  return sum;
}

/// ω_median, Eq. (12), in bins: where the cumulative sum over a spectrum's bins reaches half of the
/// total, linear between bins; 0 if bin 0 holds half or more. `within` and the lane sums behind
/// `sums` come from `cumulate`. `nyquist` is the value of bin N/2, or 0 if that bin does not count.
///
/// The function counts all bins with a cumulative sum below half. Leaving the loop at the median
/// would take longer, because a processor cannot predict where the median is.
template <typename Rows>
double median_bin(const SimdSums& sums, double nyquist, int nyquist_bin, Rows rows,
                  const double* within) noexcept {
  constexpr int lanes = SlidingDft::lanes;
  const double half = 0.5 * (sums.total() + nyquist);
  if (sums.total() < half) return (nyquist_bin - 1) + (half - sums.total()) / nyquist;
  std::int64_t bin = 0;
  for (int lane = 0; lane < lanes; ++lane) {
    const double rest = half - sums.before[lane];
    for (int row = 1; row <= rows; ++row) bin += within[row * lanes + lane] < rest ? 1 : 0;
  }
  bin =
      std::min<std::int64_t>(bin, rows * lanes - 1);  // sums in another order may round differently
  const std::int64_t lane = bin / rows;
  const double* const median = within + (bin - lane * rows) * lanes + lane;
  const double inside = median[lanes] - median[0];
  if (bin == 0 || !(inside > 0.0)) return 0.0;
  const double rest = half - sums.before[lane] - median[0];
  return static_cast<double>(bin - 1) + std::min(1.0, rest / inside);
}

/// |X|², row by row.
auto squared_magnitudes(const SlidingDft& dft) noexcept {
  return [real = dft.reals().data(), imaginary = dft.imaginaries().data()](int row) -> SpectrumRow {
    return ConstSpectrumRowMap(real + row * SlidingDft::lanes).square() +
           ConstSpectrumRowMap(imaginary + row * SlidingDft::lanes).square();
  };
}

/// |X|, likewise.
auto magnitudes(const SlidingDft& dft) noexcept {
  return
      [squared = squared_magnitudes(dft)](int row) -> SpectrumRow { return squared(row).sqrt(); };
}

}  // namespace

SpectrumSummary::SpectrumSummary(const SlidingDft& dft, SpectrumKind kind, bool nyquist)
    : window_(dft.window()),
      rows_(dft.rows()),
      magnitude_(kind == SpectrumKind::magnitude),
      nyquist_counts_(nyquist),
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
  double* const within = within_simd_width_.data();
  const auto squared = squared_magnitudes(dft);
  SpectrumRow energy = SpectrumRow::Zero();
  for (int row = 0; row < rows; ++row) energy += squared(row);
  SpectrumValues values;
  values.mean_square = mean_square(energy.sum(), dft.reals()[0], nyquist, window_);
  if (values.mean_square > negligible_mean_square) {
    const double last = nyquist_counts_ ? std::abs(nyquist) : 0.0;
    const SpectrumRow sum = cumulate(rows, magnitudes(dft), within);
    values.median_bin = median_bin(SimdSums::of(sum), last, window_ / 2, rows, within);
  }
  return values;
}

SpectrumValues SpectrumSummary::operator()(const SlidingDft& dft) noexcept {
  return with_rows(
      rows_, [&](auto rows) { return magnitude_ ? of_magnitude(rows, dft) : of_power(rows, dft); });
}

SlidingDft::SlidingDft(int window)
    : bins_(window / 2 + 1), nyquist_turn_(window % 2 == 0 ? -1.0 : 0.0) {
  if (window < 2) {
    throw InputError("a sliding window needs two or more samples, got " + std::to_string(window));
  }
  const int paired = (window + 1) / 2;
  rows_ = (paired + lanes - 1) / lanes;
  samples_.resize(static_cast<std::size_t>(window));
  for (auto* part : {&real_, &imaginary_, &cosine_, &sine_}) {
    part->resize(static_cast<std::size_t>(rows_ * lanes));
  }
  for (int k = 0; k < paired; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / window;
    cosine_[place(k)] = std::cos(angle);
    sine_[place(k)] = std::sin(angle);
  }
}

void SlidingDft::reset() noexcept {
  for (auto* values : {&samples_, &real_, &imaginary_}) {
    std::fill(values->begin(), values->end(), 0.0);
  }
  nyquist_ = 0.0;
  oldest_ = 0;
}

void SlidingDft::push(double sample) noexcept {
  const double change = sample - samples_[oldest_];
  samples_[oldest_] = sample;
  oldest_ = oldest_ + 1 == samples_.size() ? 0 : oldest_ + 1;
  nyquist_ = nyquist_turn_ * (nyquist_ + change);
  double* const x = real_.data();
  double* const y = imaginary_.data();
  const double* const cosine = cosine_.data();
  const double* const sine = sine_.data();
  const std::size_t count = real_.size();
  // The arrays do not overlap. The compiler cannot know this.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC ivdep
#endif
  for (std::size_t i = 0; i < count; ++i) {
    const double real = x[i] + change;
    const double imaginary = y[i];
    x[i] = real * cosine[i] - imaginary * sine[i];
    y[i] = real * sine[i] + imaginary * cosine[i];
  }
}

double SlidingDft::real(int bin) const noexcept {
  return 2 * bin == window() ? nyquist_ : real_[place(bin)];
}

double SlidingDft::imaginary(int bin) const noexcept {
  return 2 * bin == window() ? 0.0 : imaginary_[place(bin)];
}

double SlidingDft::squared_magnitude(int bin) const noexcept {
  return real(bin) * real(bin) + imaginary(bin) * imaginary(bin);
}

}  // namespace touchdown
