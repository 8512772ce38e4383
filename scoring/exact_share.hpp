#pragma once

#include <cstdint>

#include "core/interval.hpp"

namespace touchdown::scoring {

/// The share of `trials` that went well, with the exact interval of Clopper and Pearson (1934): the
/// shares under which as many as that, or as few, have a probability of at least (1 − level)/2.
/// Takes the trials for independent. NaN without any.
Interval exact_share(std::int64_t successes, std::int64_t trials, double level);

}  // namespace touchdown::scoring
