#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace touchdown::fuzz {

/// A `.npz` of arrays that the input holds one after the other: a byte that chooses one of `names`,
/// two bytes with the size (little endian), and so many bytes of a `.npy`. Sizes and checksums of
/// the archive are right, so that what is fuzzed are the arrays.
std::string archive_of(std::string_view input, const std::vector<std::string>& names);

}  // namespace touchdown::fuzz
