#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "estimator/models/arrays.hpp"

namespace touchdown {

/// What a `.npy` file begins with.
inline constexpr std::string_view npy_magic = "\x93NUMPY";

/// Gives the bytes of a `.npy` file in their order: fills the span, as far as there are any, and
/// returns how many.
using NpyBytes = std::function<std::size_t(std::span<char>)>;

/// Reads float64, float32, whole numbers (those beyond 2^53 rounded) and bool, C and Fortran order,
/// one or two axes, formats 1.0 to 3.0.
/// Errors: `InputError` for anything else or when bytes are missing; `name` starts the message.
ModelArray from_npy(std::string_view bytes, const std::string& name);

/// As above, from a file of `size` bytes. Errors: also for an array of more than `most` numbers,
/// before they are read.
ModelArray read_npy(const NpyBytes& bytes, std::size_t size, const std::string& name,
                    std::size_t most);

}  // namespace touchdown
