#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include <msgpack.hpp>

namespace touchdown {

/// Packs a number as a float 64, always. `msgpack::packer::pack_double` turns whole numbers into
/// integers, which loses the sign of −0 and gives readers a key whose type changes from row to row.
inline void pack_float64(msgpack::sbuffer& buffer, double value) {
  constexpr auto float64 = static_cast<char>(0xcbU);
  const auto bits = std::bit_cast<std::uint64_t>(value);
  std::array<char, 9> bytes{float64};
  for (std::size_t i = 0; i < 8; ++i) bytes[i + 1] = static_cast<char>(bits >> (56U - 8U * i));
  buffer.write(bytes.data(), bytes.size());
}

}  // namespace touchdown
