#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

namespace touchdown::scoring {

/// Counts of a quantity in `bins` equal bins over [low, high). Values beyond count in the outermost
/// bins. Histograms with the same bins can be added; an empty one takes the other's bins.
class Histogram {
 public:
  Histogram() = default;
  Histogram(double low, double high, std::size_t bins)
      : low_(low), width_((high - low) / static_cast<double>(bins)), count_(bins, 0) {}

  void add(double value);
  Histogram& operator+=(const Histogram& other);

  const std::vector<std::int64_t>& count() const { return count_; }
  double bin_width() const { return width_; }
  std::int64_t total() const;
  /// The shares of all counts in bins that are merged in groups of `merged`. Empty without counts.
  std::vector<double> shares(std::size_t merged) const;

  static auto members(auto& histogram) {
    return std::tie(histogram.low_, histogram.width_, histogram.count_);
  }

 private:
  double low_ = 0.0;
  double width_ = 1.0;
  std::vector<std::int64_t> count_;
};

/// The first Wasserstein distance, ∫ |F(x) − G(x)| dx, in the unit of the quantity. Its error is at
/// most one bin width. NaN when one histogram is empty.
double wasserstein_distance(const Histogram& a, const Histogram& b);

/// The overlap Σ min(p, q) of two distributions, given by their shares of the same bins: 1 for
/// equal ones, 0 for disjoint ones. NaN when one has no bins.
double overlap(std::span<const double> p, std::span<const double> q);

}  // namespace touchdown::scoring
