#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace touchdown::recordings {

/// A NumPy array of real numbers with one or two axes, row by row.
struct NpyArray {
  std::vector<std::size_t> shape;
  std::vector<double> data;

  std::size_t rows() const { return shape.empty() ? 1 : shape[0]; }
  std::size_t columns() const { return shape.size() < 2 ? 1 : shape[1]; }
};

/// The content of a `.npy` file: float64, little endian, C order, format 1.0.
std::string to_npy(const NpyArray& array);

/// Reads float64 and float32, C and Fortran order, one or two axes, formats 1.0 to 3.0.
/// Errors: `InputError` for anything else or when bytes are missing; `name` starts the message.
NpyArray from_npy(std::string_view bytes, const std::string& name);

}  // namespace touchdown::recordings
