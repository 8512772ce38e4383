#include "scoring/histogram.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace touchdown::scoring {

double overlap(std::span<const double> p, std::span<const double> q) {
  if (p.empty() || q.empty()) return std::numeric_limits<double>::quiet_NaN();
  double common = 0.0;
  for (std::size_t bin = 0; bin < p.size(); ++bin) common += std::min(p[bin], q[bin]);
  return common;
}

void Histogram::add(double value) {
  if (std::isnan(value) || count_.empty()) return;
  const double last = static_cast<double>(count_.size() - 1);
  ++count_[static_cast<std::size_t>(std::clamp(std::floor((value - low_) / width_), 0.0, last))];
}

Histogram& Histogram::operator+=(const Histogram& other) {
  if (count_.empty()) return *this = other;
  for (std::size_t i = 0; i < other.count_.size(); ++i) count_[i] += other.count_[i];
  return *this;
}

std::int64_t Histogram::total() const {
  return std::accumulate(count_.begin(), count_.end(), std::int64_t{0});
}

std::vector<double> Histogram::shares(std::size_t merged) const {
  const auto all = static_cast<double>(total());
  if (all == 0.0) return {};
  std::vector<double> shares;
  for (std::size_t i = 0; i < count_.size(); i += merged) {
    std::int64_t inside = 0;
    for (std::size_t j = i; j < std::min(i + merged, count_.size()); ++j) inside += count_[j];
    shares.push_back(static_cast<double>(inside) / all);
  }
  return shares;
}

double wasserstein_distance(const Histogram& a, const Histogram& b) {
  const auto total_a = static_cast<double>(a.total());
  const auto total_b = static_cast<double>(b.total());
  if (total_a == 0.0 || total_b == 0.0) return std::numeric_limits<double>::quiet_NaN();
  double distance = 0.0;
  std::int64_t below_a = 0;
  std::int64_t below_b = 0;
  for (std::size_t i = 0; i < a.count().size(); ++i) {
    below_a += a.count()[i];
    below_b += b.count()[i];
    distance +=
        std::abs(static_cast<double>(below_a) / total_a - static_cast<double>(below_b) / total_b);
  }
  return distance * a.bin_width();
}

}  // namespace touchdown::scoring
