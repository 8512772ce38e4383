#pragma once

#include <array>
#include <cstddef>

#include "estimator/evidence/curves.hpp"

namespace touchdown {

/// Replaces a curve by the nearest one, in least squares over its knots, that never falls. Pools
/// adjacent violators: Ayer, Brunk, Ewing, Reid, Silverman (1955).
inline void make_monotone(EvidenceCurve& curve) noexcept {
  struct Pool {
    double mean;
    std::size_t knots;
  };
  std::array<Pool, evidence_knots> pools;
  std::size_t count = 0;
  for (const float value : curve) {
    pools[count++] = {static_cast<double>(value), 1};
    while (count > 1 && pools[count - 2].mean > pools[count - 1].mean) {
      Pool& before = pools[count - 2];
      const Pool& last = pools[count - 1];
      const std::size_t knots = before.knots + last.knots;
      before.mean = (before.mean * static_cast<double>(before.knots) +
                     last.mean * static_cast<double>(last.knots)) /
                    static_cast<double>(knots);
      before.knots = knots;
      --count;
    }
  }
  std::size_t knot = 0;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < pools[i].knots; ++k) {
      curve[knot++] = static_cast<float>(pools[i].mean);
    }
  }
}

}  // namespace touchdown
