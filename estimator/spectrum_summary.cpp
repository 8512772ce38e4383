#include "estimator/spectrum_summary.hpp"

#include <algorithm>

#include <Eigen/Core>

namespace touchdown {
namespace {

constexpr int lanes = SlidingDft::lanes;

/// Eigen's arrays, because left to itself the compiler takes square roots one by one.
using Lanes = Eigen::Array<double, lanes, 1>;
using ConstLanesMap = Eigen::Map<const Lanes>;

/// Sums of the first 1, 2, … 8 values, by a tree: a chain of additions would wait for each other.
struct PrefixSums {
  explicit PrefixSums(const double* x) noexcept {
    static_assert(lanes == 8);
    const double x23 = x[2] + x[3];
    const double x45 = x[4] + x[5];
    const double x67 = x[6] + x[7];
    sum[0] = x[0];
    sum[1] = x[0] + x[1];
    sum[2] = sum[1] + x[2];
    sum[3] = sum[1] + x23;
    sum[4] = sum[3] + x[4];
    sum[5] = sum[3] + x45;
    sum[6] = sum[5] + x[6];
    sum[7] = sum[3] + (x45 + x67);
  }
  double sum[lanes];
};

}  // namespace

SpectrumSummary::SpectrumSummary(const SlidingDft& dft, SpectrumKind kind, bool nyquist)
    : window_(dft.window()),
      bins_(dft.bins()),
      magnitude_(kind == SpectrumKind::magnitude),
      nyquist_bin_(dft.window() % 2 == 0 ? dft.window() / 2 : -1),
      nyquist_counts_(nyquist),
      weights_(static_cast<std::size_t>(dft.rows())) {}

template <typename SquaredRow>
SpectrumValues SpectrumSummary::summarise(const SquaredRow& squared_row) noexcept {
  const auto rows = static_cast<int>(weights_.size());
  const double n = window_;
  Lanes energy = Lanes::Zero();
  Lanes weight = Lanes::Zero();
  for (int r = 0; r < rows; ++r) {
    const Lanes squared = squared_row(r);
    Eigen::Map<Lanes> weights(weights_[static_cast<std::size_t>(r)].lane);
    energy += squared;
    if (magnitude_) {
      weights = squared.sqrt();
      weight += weights;
    } else {
      weights = squared;
    }
  }
  if (!magnitude_) {
    weight = energy;
  }

  // Bins that stand for two frequencies, +ω and −ω, count twice.
  const int last_row = (bins_ - 1) % rows;
  const int last_lane = (bins_ - 1) / rows;
  const double first = weights_.front().lane[0];
  const double last =
      nyquist_bin_ >= 0 ? weights_[static_cast<std::size_t>(last_row)].lane[last_lane] : 0.0;
  const double unpaired = magnitude_ ? first * first + last * last : first + last;
  SpectrumValues values;
  values.mean_square = (2.0 * PrefixSums(energy.data()).sum[lanes - 1] - unpaired) / (n * n);
  if (!(values.mean_square > negligible_rms * negligible_rms)) {
    return values;
  }

  const PrefixSums cumulative(weight.data());
  double total = cumulative.sum[lanes - 1];
  if (!nyquist_counts_ && nyquist_bin_ >= 0) {
    total -= last;
  }
  const double half = 0.5 * total;

  // Counting comparisons instead of leaving a loop early: where the median is, is not predictable.
  int lane = 0;
  double below = 0.0;
  for (int i = 0; i < lanes - 1; ++i) {
    const bool passed = cumulative.sum[i] < half;
    lane += passed ? 1 : 0;
    below = passed ? cumulative.sum[i] : below;
  }
  int passed_rows = 0;
  double sum = below;
  for (int r = 0; r < rows - 1; ++r) {
    sum += weights_[static_cast<std::size_t>(r)].lane[lane];
    const bool passed = sum < half;
    passed_rows += passed ? 1 : 0;
    below = passed ? sum : below;
  }
  const int bin = lane * rows + passed_rows;
  const double inside = weights_[static_cast<std::size_t>(passed_rows)].lane[lane];
  if (bin > 0 && inside > 0.0) {
    values.median_bin = (bin - 1) + std::min(1.0, (half - below) / inside);
  }
  return values;
}

SpectrumValues SpectrumSummary::operator()(const SlidingDft& dft) noexcept {
  return summarise([&dft](int r) { return ConstLanesMap(dft.row(r).squared); });
}

SpectrumValues SpectrumSummary::operator()(const SlidingDft& clean, const SlidingDft& noise,
                                           double sigma) noexcept {
  return summarise([&clean, &noise, sigma](int r) -> Lanes {
    const SlidingDft::Row& a = clean.row(r);
    const SlidingDft::Row& z = noise.row(r);
    return (ConstLanesMap(a.real) + sigma * ConstLanesMap(z.real)).square() +
           (ConstLanesMap(a.imaginary) + sigma * ConstLanesMap(z.imaginary)).square();
  });
}

}  // namespace touchdown
