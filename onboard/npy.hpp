#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "estimator/models/arrays.hpp"

namespace touchdown {

/// The first bytes of a `.npy` file.
inline constexpr std::string_view npy_magic = "\x93NUMPY";

/// A source of the bytes of a `.npy` file, in order. It fills the span as far as bytes are left and
/// returns their number.
using NpyBytes = std::function<std::size_t(std::span<char>)>;

/// Reads float64, float32, whole numbers (those beyond 2^53 rounded), bool, and datetime64 and
/// timedelta64 as seconds (NaT as NaN), C and Fortran order, one or two axes, formats 1.0 to 3.0.
/// Errors: `InputError` for anything else or when bytes are missing; `name` starts the message.
ModelArray from_npy(std::string_view bytes, const std::string& name);

/// As above, from a file of `size` bytes. Errors: also for an array of more than `most` numbers,
/// before reading them.
ModelArray read_npy(const NpyBytes& bytes, std::size_t size, const std::string& name,
                    std::size_t most);

}  // namespace touchdown
