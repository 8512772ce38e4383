#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "recordings/bags/storage/compression.hpp"

namespace touchdown::recordings {

/// Opcodes of the records that are read; mcap.dev/spec, format version 0.
enum class McapOp : std::uint8_t {
  invalid = 0x00,
  header = 0x01,
  footer = 0x02,
  schema = 0x03,
  channel = 0x04,
  message = 0x05,
  chunk = 0x06,
  data_end = 0x0f,
};

inline constexpr std::string_view mcap_magic("\x89MCAP0\r\n", 8);
/// Opcode and length.
inline constexpr std::uint64_t mcap_head_bytes = 9;

/// Channels and schemas seen so far.
struct McapChannels {
  struct Channel {
    std::uint16_t schema = 0;
    std::string topic;
    std::string encoding;
    bool operator==(const Channel&) const = default;
  };
  std::map<std::uint16_t, std::string> schema_name;
  std::map<std::uint16_t, Channel> channel;

  /// Errors: `InputError` for a channel or a schema that differs from an earlier one of its id.
  void add_schema(std::string_view content);
  void add_channel(std::string_view content);
};

struct McapMessage {
  std::uint16_t channel = 0;
  std::uint64_t log_time = 0;
  std::string_view data;
};
McapMessage mcap_message(std::string_view content);

/// The content of a chunk record, of which the end may be missing.
struct McapChunk {
  std::uint64_t uncompressed_size = 0;
  std::uint32_t crc = 0;  ///< 0: none
  Compression compression = Compression::none;
  std::uint64_t size = 0;    ///< of the complete records
  std::string_view records;  ///< compressed
};
McapChunk mcap_chunk(std::string_view content);

/// CRC-32 as MCAP uses it.
std::uint32_t mcap_crc(std::string_view bytes);

/// Calls `use` for each record. Returns the number of bytes of whole records.
std::size_t for_each_mcap_record(std::string_view bytes,
                                 const std::function<void(McapOp, std::string_view content)>& use);

}  // namespace touchdown::recordings
