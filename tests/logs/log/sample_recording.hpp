#pragma once

#include <cstddef>

#include "logs/recording.hpp"

namespace touchdown::logs::test {

/// A recording in which no two numbers are equal, with the odd ones (NaN, infinities, negative
/// zero, denormals) in between.
Recording sample_recording(std::size_t steps, bool with_truth = true);

}  // namespace touchdown::logs::test
