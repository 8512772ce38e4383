#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace touchdown::noise {

inline double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// Autocorrelation of a zero-mean process: mean product of values at a lag in steps.
inline double correlation(const std::vector<double>& values, std::size_t lag = 0) {
  double sum = 0.0;
  for (std::size_t k = 0; k + lag < values.size(); ++k) sum += values[k] * values[k + lag];
  return sum / static_cast<double>(values.size() - lag);
}

}  // namespace touchdown::noise
