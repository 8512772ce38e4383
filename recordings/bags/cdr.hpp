#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace touchdown::recordings {

/// Reads the values of a message in the order of their definition, from bytes in CDR (XCDR1, OMG
/// DDS-XTypes 7.4.3), of either byte order. Values are aligned to their size, relative to the byte
/// after the four bytes of the header. Errors: `InputError` when the header is another one, or when
/// the bytes end before a value does; no declared size is trusted.
class CdrReader {
 public:
  explicit CdrReader(std::string_view payload);

  double number();  ///< a 64-bit floating-point number
  std::int32_t int32();
  std::uint32_t uint32();
  /// Without the NUL at its end.
  std::string_view text();
  void numbers(std::vector<double>& values);
  void texts(std::vector<std::string_view>& values);

 private:
  template <typename T>
  T take();
  /// The number of items of a sequence, of which each has at least `bytes`.
  std::uint32_t count(std::size_t bytes);

  std::string_view bytes_;
  std::size_t at_ = 0;
  bool is_swapped_ = false;
};

}  // namespace touchdown::recordings
