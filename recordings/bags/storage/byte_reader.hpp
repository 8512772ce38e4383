#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "core/error.hpp"

namespace touchdown::recordings {

/// Reads little-endian numbers and texts from bytes. Errors: `InputError` when the bytes end before
/// a value does; no size that the bytes declare is trusted.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  template <typename T>
  T number() {
    T value{};
    const std::string_view from = take(sizeof(T));
    std::memcpy(&value, from.data(), sizeof(T));
    return value;
  }
  std::string_view take(std::uint64_t size) {
    if (size > bytes_.size()) throw InputError("a value ends beyond its record");
    const std::string_view taken = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return taken;
  }
  /// A text or an array: its size as `std::uint32_t`, then its bytes.
  std::string_view text() { return take(number<std::uint32_t>()); }

  std::string_view rest() const { return bytes_; }

 private:
  std::string_view bytes_;
};

}  // namespace touchdown::recordings
