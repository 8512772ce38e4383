#include "scoring/distributions/overlap.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace touchdown::scoring {

double overlap(std::span<const double> p, std::span<const double> q) {
  if (p.empty() || q.empty()) return std::numeric_limits<double>::quiet_NaN();
  double common = 0.0;
  for (std::size_t bin = 0; bin < p.size(); ++bin) common += std::min(p[bin], q[bin]);
  return common;
}

}  // namespace touchdown::scoring
