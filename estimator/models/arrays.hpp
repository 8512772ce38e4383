#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace touchdown {

/// Real numbers with one or two axes, row by row: the part of NumPy's arrays that models need.
struct ModelArray {
  std::vector<std::size_t> shape;
  std::vector<double> data;

  [[nodiscard]] std::size_t rows() const { return shape.empty() ? 1 : shape[0]; }
  [[nodiscard]] std::size_t columns() const { return shape.size() < 2 ? 1 : shape[1]; }

  /// For programs that save arrays in a form of their own.
  static auto members(auto& array) { return std::tie(array.shape, array.data); }
  bool operator==(const ModelArray&) const = default;
};

/// A fitted model as named arrays, as its file holds them.
using ModelArrays = std::map<std::string, ModelArray>;

/// Errors: `InputError` if arrays of these names are missing; the message lists them and names
/// `what`.
void require_arrays(const ModelArrays& arrays, std::string_view what,
                    std::vector<std::string> names);

/// A text as an array of its bytes: `bytes(npz["provenance"].astype("u1")).decode()`.
ModelArray array_of_text(const std::string& text);

/// The inverse. Errors: `InputError` that begins with `name` for numbers that are no bytes.
std::string text_of_array(const ModelArray& array, const std::string& name);

}  // namespace touchdown
