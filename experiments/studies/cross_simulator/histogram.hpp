#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace touchdown::experiments {

/// Counts of a quantity in `bins` equal bins over [low, high); what lies beyond counts in the
/// outermost ones. Histograms over the same bins add; an empty one takes the other's bins.
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

 private:
  double low_ = 0.0;
  double width_ = 1.0;
  std::vector<std::int64_t> count_;
};

/// The first Wasserstein distance, ∫ |F(x) − G(x)| dx: how far, in the quantity's own unit, the
/// mass of one distribution must be moved on average to become the other. Off by at most one bin's
/// width. NaN when one is empty.
double wasserstein_distance(const Histogram& a, const Histogram& b);

/// Σ min(p, q) after adding up every `merged` neighbouring bins: 1 for equal distributions, 0 for
/// disjoint ones. NaN when one is empty.
double overlap(const Histogram& a, const Histogram& b, std::size_t merged);

}  // namespace touchdown::experiments
