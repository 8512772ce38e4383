#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace touchdown::logs {

/// Reads the values of a message in the order of their definition, from bytes in CDR (XCDR1, OMG
/// DDS-XTypes 7.4.3), of either byte order. Values are aligned to their size, relative to the byte
/// after the four bytes of the header. Errors: `InputError` when the header is another one, or when
/// the bytes end before a value does; no declared size is trusted.
class CdrReader {
 public:
  explicit CdrReader(std::string_view payload);

  template <typename T>
  T take() {
    std::array<char, sizeof(T)> raw{};
    std::memcpy(raw.data(), skip(sizeof(T), 1), sizeof(T));
    if (is_swapped_) std::reverse(raw.begin(), raw.end());
    return std::bit_cast<T>(raw);
  }
  /// Skips values of this size. Returns where they begin.
  const char* skip(std::size_t size, std::size_t count);
  /// Without the NUL at its end.
  std::string_view text();
  /// The number of items of a sequence, of which each has at least `bytes`.
  std::uint32_t count(std::size_t bytes);

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
  bool is_swapped_ = false;
};

}  // namespace touchdown::logs
