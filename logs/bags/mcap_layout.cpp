#include <algorithm>
#include <boost/crc.hpp>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "core/error.hpp"
#include "logs/bags/mcap_reader.hpp"

namespace touchdown::logs {

namespace {

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
  Schema one;
  one.name = reader.text();
  one.encoding = reader.text();
  one.text = reader.text();
  define(schema, id, std::move(one), "schema");
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

namespace {

/// Records outside of chunks are read together up to this size.
constexpr std::uint64_t most_part_bytes = std::uint64_t{1} << 20U;
/// Definitions are read whole; no schema is as large as this.
constexpr std::uint64_t most_definition_bytes = std::uint64_t{1} << 26U;

/// Walks over the records of a file.
class Walk {
 public:
  explicit Walk(const RandomFile& file) : file_(file) {}

  McapLayout layout() {
    file_.read(0, mcap_magic.size(), bytes_);
    if (bytes_ != mcap_magic) {
      throw InputError(
          fmt::format("{}: is no MCAP file: it does not begin with \\x89MCAP0", file_.name()));
    }
    offset_ = mcap_magic.size();
    while (!is_at_end_) {
      try {
        step();
      } catch (const InputError& error) {
        throw InputError(fmt::format("{}: byte {}: {}", file_.name(), offset_, error.what()));
      }
    }
    const auto by_start = [](const McapPart& a, const McapPart& b) { return a.start < b.start; };
    layout_.is_in_file_order = std::is_sorted(layout_.parts.begin(), layout_.parts.end(), by_start);
    std::stable_sort(layout_.parts.begin(), layout_.parts.end(), by_start);
    return std::move(layout_);
  }

 private:
  void step() {
    // The head of the record, with the times of a chunk or of a message behind it.
    file_.read(offset_, mcap_head_bytes + 16, bytes_);
    if (bytes_.size() < mcap_head_bytes) return end("the end of the file is missing");
    ByteReader head(bytes_);
    const auto op = static_cast<McapOp>(head.number<std::uint8_t>());
    const auto size = head.number<std::uint64_t>();
    const std::uint64_t content = offset_ + mcap_head_bytes;
    const std::uint64_t there = std::min(size, file_.size() - content);
    const bool is_cut = there < size;
    if (op == McapOp::invalid) {
      end(fmt::format("from byte {} on it holds no records", offset_));
      return;
    }
    if (op == McapOp::chunk) {
      if (there >= 16 || !is_cut) add_chunk(head, {content, there, 0, true, is_cut});
      if (is_cut) return end("the rest of a chunk is missing");
    }
    if (is_cut) return end("the rest of a record is missing");
    if (op == McapOp::message) add_message(head, mcap_head_bytes + size);
    if (op == McapOp::schema) layout_.channels.add_schema(read(content, size));
    if (op == McapOp::channel) layout_.channels.add_channel(read(content, size));
    if (op == McapOp::data_end) finish_data(ByteReader(read(content, size)));
    if (op == McapOp::footer) return finish(content, ByteReader(read(content, size)));
    offset_ = content + size;
  }

  std::string_view read(std::uint64_t offset, std::uint64_t size) {
    if (size > most_definition_bytes) throw InputError("a definition is too large");
    file_.read(offset, size, bytes_);
    return bytes_;
  }

  void add_chunk(ByteReader& head, McapPart part) {
    part.start = head.number<std::uint64_t>();
    layout_.parts.push_back(part);
  }

  void add_message(ByteReader& head, std::uint64_t size) {
    (void)head.number<std::uint16_t>();
    (void)head.number<std::uint32_t>();
    const auto time = head.number<std::uint64_t>();
    std::vector<McapPart>& parts = layout_.parts;
    const bool continues = !parts.empty() && !parts.back().is_chunk &&
                           parts.back().offset + parts.back().size == offset_ &&
                           parts.back().size + size <= most_part_bytes;
    if (!continues) parts.push_back({offset_, 0, time, false, false});
    parts.back().size += size;
    parts.back().start = std::min(parts.back().start, time);
  }

  void finish_data(ByteReader content) {
    check(content.number<std::uint32_t>(), 0, offset_, "the data section");
  }

  /// The checksum of the summary includes the footer up to the checksum.
  void finish(std::uint64_t footer, ByteReader content) {
    const auto summary = content.number<std::uint64_t>();
    (void)content.number<std::uint64_t>();
    const std::uint64_t start = summary == 0 ? offset_ : summary;
    check(content.number<std::uint32_t>(), start, footer + 16, "the summary");
    file_.read(footer + 20, mcap_magic.size(), bytes_);
    end(bytes_ == mcap_magic ? "" : "the magic bytes at its end are missing");
  }

  void check(std::uint32_t expected, std::uint64_t from, std::uint64_t to, const char* what) {
    if (expected == 0) return;
    if (from > to) throw InputError("the footer names a summary behind it");
    boost::crc_32_type crc;
    std::string bytes;
    constexpr std::uint64_t at_once = std::uint64_t{1} << 20U;
    for (std::uint64_t at = from; at < to; at += bytes.size()) {
      file_.read(at, std::min(at_once, to - at), bytes);
      crc.process_bytes(bytes.data(), bytes.size());
    }
    if (crc.checksum() != expected) {
      throw InputError(fmt::format("the checksum of {} differs: the file was changed", what));
    }
  }

  void end(std::string missing) {
    is_at_end_ = true;
    if (missing.empty()) return;
    layout_.end_missing = fmt::format("cut off at byte {}: {}", file_.size(), missing);
  }

  const RandomFile& file_;
  std::string bytes_;
  std::uint64_t offset_ = 0;
  bool is_at_end_ = false;
  McapLayout layout_;
};

}  // namespace

McapLayout mcap_layout(const RandomFile& file) { return Walk(file).layout(); }

}  // namespace touchdown::logs
