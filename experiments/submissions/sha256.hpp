#pragma once

#include <string>
#include <string_view>

namespace touchdown::experiments {

/// SHA-256 (FIPS 180-4) of bytes, as `sha256sum` prints it: 64 hexadecimal digits.
std::string sha256(std::string_view bytes);

}  // namespace touchdown::experiments
