#include "recordings/bags/storage/mcap_records.hpp"

#include <boost/crc.hpp>

#include <fmt/format.h>

#include "core/error.hpp"
#include "recordings/bags/storage/byte_reader.hpp"

namespace touchdown::recordings {

namespace {

/// Adds a definition, or checks that it repeats the earlier one.
template <typename T>
void define(std::map<std::uint16_t, T>& known, std::uint16_t id, T value, const char* what) {
  const auto [at, is_new] = known.try_emplace(id, value);
  if (!is_new && !(at->second == value)) {
    throw InputError(fmt::format("{} {} is defined twice, differently", what, id));
  }
}

}  // namespace

void McapChannels::add_schema(std::string_view content) {
  ByteReader reader(content);
  const auto id = reader.number<std::uint16_t>();
  if (id == 0) throw InputError("a schema has the id 0");
  define(schema_name, id, std::string(reader.text()), "schema");
}

void McapChannels::add_channel(std::string_view content) {
  ByteReader reader(content);
  const auto id = reader.number<std::uint16_t>();
  Channel one;
  one.schema = reader.number<std::uint16_t>();
  one.topic = reader.text();
  one.encoding = reader.text();
  define(channel, id, std::move(one), "channel");
}

McapMessage mcap_message(std::string_view content) {
  ByteReader reader(content);
  McapMessage message;
  message.channel = reader.number<std::uint16_t>();
  (void)reader.number<std::uint32_t>();  // sequence
  message.log_time = reader.number<std::uint64_t>();
  (void)reader.number<std::uint64_t>();  // publish time
  message.data = reader.rest();
  return message;
}

McapChunk mcap_chunk(std::string_view content) {
  ByteReader reader(content);
  (void)reader.number<std::uint64_t>();  // start
  (void)reader.number<std::uint64_t>();  // end
  McapChunk chunk;
  chunk.uncompressed_size = reader.number<std::uint64_t>();
  chunk.crc = reader.number<std::uint32_t>();
  const std::string_view name = reader.text();
  if (name == "lz4") {
    chunk.compression = Compression::lz4;
  } else if (name == "zstd") {
    chunk.compression = Compression::zstd;
  } else if (!name.empty()) {
    throw InputError(
        fmt::format("compression '{}': expected none, lz4 or zstd", name.substr(0, 32)));
  }
  chunk.size = reader.number<std::uint64_t>();
  chunk.records = reader.rest().substr(0, chunk.size);
  return chunk;
}

std::uint32_t mcap_crc(std::string_view bytes) {
  boost::crc_32_type crc;
  crc.process_bytes(bytes.data(), bytes.size());
  return crc.checksum();
}

std::size_t for_each_mcap_record(std::string_view bytes,
                                 const std::function<void(McapOp, std::string_view)>& use) {
  const std::size_t all = bytes.size();
  while (bytes.size() >= mcap_head_bytes) {
    ByteReader head(bytes);
    const auto op = head.number<std::uint8_t>();
    const auto size = head.number<std::uint64_t>();
    if (size > head.rest().size()) break;
    use(static_cast<McapOp>(op), head.take(size));
    bytes = head.rest();
  }
  return all - bytes.size();
}

}  // namespace touchdown::recordings
