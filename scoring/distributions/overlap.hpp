#pragma once

#include <span>

namespace touchdown::scoring {

/// The overlap Σ min(p, q) of two distributions, given by their shares of the same bins: 1 for
/// equal ones, 0 for disjoint ones. NaN when one has no bins.
double overlap(std::span<const double> p, std::span<const double> q);

}  // namespace touchdown::scoring
