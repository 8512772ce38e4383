#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <msgpack.hpp>

#include "logs/recording.hpp"

namespace touchdown::logs {

using LogPacker = msgpack::packer<msgpack::sbuffer>;

inline void pack_text(LogPacker& packer, std::string_view text) {
  const auto size = static_cast<std::uint32_t>(text.size());
  packer.pack_str(size).pack_str_body(text.data(), size);
}

/// Number of bytes before the first key of a map with this first byte; 0 if no map begins with it.
inline std::size_t map_header_size(char first) {
  const auto byte = static_cast<unsigned char>(first);
  if ((byte & 0xf0U) == 0x80U) return 1;
  if (byte == 0xdeU) return 3;
  return byte == 0xdfU ? 5 : 0;
}

/// Always packs a number as a float 64. `msgpack::packer::pack_double` packs whole numbers as
/// integers: the sign of −0 gets lost, and the type of a key changes from row to row.
inline void pack_float64(msgpack::sbuffer& buffer, double value) {
  constexpr auto float64 = static_cast<char>(0xcbU);
  const auto bits = std::bit_cast<std::uint64_t>(value);
  std::array<char, 9> bytes{float64};
  for (std::size_t i = 0; i < 8; ++i) bytes[i + 1] = static_cast<char>(bits >> (56U - 8U * i));
  buffer.write(bytes.data(), bytes.size());
}

/// Appends the origin of a log to a map that is being packed: of a run `config: {touchdown: {…}}`,
/// of a log with the name of its robot `config: {robot: …}`.
void pack_origin(LogPacker& packer, const RecordingInfo& info);

/// Reads `config.touchdown` of a record, or the name of the robot of a log that touchdown did not
/// write; empty if it has none. Errors: `InputError` for invalid values.
void unpack_origin(std::string_view record, std::string_view log_name,
                   std::optional<RecordingInfo>& info, std::string& robot);

}  // namespace touchdown::logs
