#pragma once

#include <cstddef>
#include <string>

#include "recordings/recording.hpp"

namespace touchdown::recordings::test {

/// A recording in which no two numbers are equal, with the odd ones (NaN, infinities, negative
/// zero, denormals) in between.
Recording sample_recording(std::size_t steps, bool with_truth = true);

/// A Python interpreter that has NumPy, or empty.
std::string python_with_numpy();

}  // namespace touchdown::recordings::test
