#pragma once

#include <ctime>

namespace touchdown::experiments {

/// Processor time of this process (s).
inline double processor_seconds() {
  timespec now = {};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Processor time that `action` takes (s).
template <typename Action>
double cost_of(const Action& action) {
  const double start = processor_seconds();
  action();
  return processor_seconds() - start;
}

}  // namespace touchdown::experiments
