#pragma once

#include <cstddef>
#include <functional>
#include <span>
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

/// Gives the bytes of a `.npy` file in their order: fills the span, as far as there are any, and
/// returns how many.
using NpyBytes = std::function<std::size_t(std::span<char>)>;

/// Reads float64 and float32, C and Fortran order, one or two axes, formats 1.0 to 3.0.
/// Errors: `InputError` for anything else or when bytes are missing; `name` starts the message.
NpyArray from_npy(std::string_view bytes, const std::string& name);

/// As above, from a file of `size` bytes. Errors: also for an array of more than `most` numbers,
/// before they are read.
NpyArray read_npy(const NpyBytes& bytes, std::size_t size, const std::string& name,
                  std::size_t most);

}  // namespace touchdown::recordings
