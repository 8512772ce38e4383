#pragma once

#include <cstdint>

#include "core/interval.hpp"

namespace touchdown::scoring {

/// The share of successful trials with the exact interval of Clopper and Pearson (1934): the shares
/// for which at least, and at most, that many successes have a probability of (1 − level)/2 or
/// more. Assumes independent trials. NaN without any.
Interval exact_share(std::int64_t successes, std::int64_t trials, double level);

}  // namespace touchdown::scoring
