#pragma once

#include <string>

#include "onboard/npy.hpp"

namespace touchdown::recordings {

/// A NumPy array of real numbers with one or two axes, row by row.
using NpyArray = ModelArray;
using touchdown::from_npy;

/// The content of a `.npy` file: float64, little endian, C order, format 1.0.
std::string to_npy(const NpyArray& array);

}  // namespace touchdown::recordings
