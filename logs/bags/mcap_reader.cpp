#include "logs/bags/mcap_reader.hpp"

#include <algorithm>
#include <boost/crc.hpp>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "logs/bags/compression.hpp"

namespace touchdown::logs {

namespace {

/// Opcode and length.
constexpr std::uint64_t head_bytes = 9;
constexpr std::uint64_t most_chunk_bytes = std::uint64_t{1} << 30U;
/// Definitions are read whole; no schema is as large as this.
constexpr std::uint64_t most_definition_bytes = std::uint64_t{1} << 26U;

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

Compression compression_of(std::string_view name) {
  if (name == "lz4") return Compression::lz4;
  if (name == "zstd") return Compression::zstd;
  if (name.empty()) return Compression::none;
  throw InputError(fmt::format("compression '{}': expected none, lz4 or zstd", name.substr(0, 32)));
}

/// The uncompressed records of a chunk. Of one that is cut off, those that are there.
std::string records_of(std::string_view content, bool is_cut) {
  ByteReader reader(content);
  (void)reader.number<std::uint64_t>();  // start
  (void)reader.number<std::uint64_t>();  // end
  const auto size = reader.number<std::uint64_t>();
  const auto crc = reader.number<std::uint32_t>();
  const Compression compression = compression_of(reader.text());
  const auto stored_size = reader.number<std::uint64_t>();
  const std::string_view stored = reader.rest().substr(0, stored_size);
  if (!is_cut && stored.size() < stored_size) {
    throw InputError(
        fmt::format("expected {} bytes of messages, found {}", stored_size, stored.size()));
  }
  Decompressed result = decompress(compression, stored, std::min(size, most_chunk_bytes));
  if (is_cut) return std::move(result.bytes);
  if (!result.fault.empty()) throw InputError(result.fault);
  if (result.bytes.size() < size) {
    throw InputError(
        fmt::format("expected {} bytes of messages, found {}", size, result.bytes.size()));
  }
  if (crc != 0 && mcap_crc(result.bytes) != crc) {
    throw InputError("its checksum differs: the file is damaged");
  }
  return std::move(result.bytes);
}

}  // namespace

McapReader::McapReader(const std::filesystem::path& path, TopicFilter wanted,
                       const std::string& name, const std::atomic<bool>* stop)
    : file_(path, name.empty() ? path.string() : name, stop),
      wanted_(std::move(wanted)),
      offset_(mcap_magic.size()) {
  file_.read(0, mcap_magic.size(), content_);
  if (content_ != mcap_magic) {
    throw InputError(
        fmt::format("{}: is no MCAP file: it does not begin with \\x89MCAP0", file_.name()));
  }
}

bool McapReader::next(BagMessage& message) {
  while (next_ == messages_.size()) {
    if (is_at_end_) return false;
    messages_.clear();
    next_ = 0;
    try {
      read_record();
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}: byte {}: {}", file_.name(), offset_, error.what()));
    }
  }
  message = messages_[next_++];
  return true;
}

void McapReader::read_record() {
  file_.read(offset_, head_bytes, content_);
  if (content_.size() < head_bytes) return end("the end of the file is missing");
  ByteReader head(content_);
  const auto op = static_cast<McapOp>(head.number<std::uint8_t>());
  const auto size = head.number<std::uint64_t>();
  if (op == McapOp::invalid) {
    return end(fmt::format("from byte {} on it holds no records", offset_));
  }
  const std::uint64_t content = offset_ + head_bytes;
  const bool is_cut = size > file_.size() - content;
  const bool is_definition = op == McapOp::schema || op == McapOp::channel;
  if (is_definition && size > most_definition_bytes && !is_cut) {
    throw InputError("a definition is too large");
  }
  const bool is_used = is_definition || op == McapOp::message || op == McapOp::data_end ||
                       op == McapOp::footer || op == McapOp::chunk;
  // Attachments can be large.
  file_.read(content, is_used ? size : 0, content_);
  if (op == McapOp::chunk) {
    try {
      read_chunk(content_, is_cut);
    } catch (const InputError& error) {
      throw InputError(fmt::format("chunk: {}", error.what()));
    }
  } else if (is_cut) {
    return end("the rest of a record is missing");
  } else if (op == McapOp::data_end) {
    check(ByteReader(content_).number<std::uint32_t>(), 0, offset_, "the data section");
  } else if (op == McapOp::footer) {
    return finish(content, content_);
  } else {
    use(op, content_, false);
  }
  if (is_cut) return end("the rest of a chunk is missing");
  offset_ = content + size;
}

/// A record of the file, or of a chunk.
void McapReader::use(McapOp op, std::string_view content, bool is_cut) {
  ByteReader reader(content);
  if (op == McapOp::schema) {
    const auto id = reader.number<std::uint16_t>();
    if (id == 0) throw InputError("a schema has the id 0");
    Schema schema;
    schema.name = reader.text();
    schema.encoding = reader.text();
    schema.text = reader.text();
    define(schemas_, id, std::move(schema), "schema");
  } else if (op == McapOp::channel) {
    const auto id = reader.number<std::uint16_t>();
    Channel channel;
    channel.schema = reader.number<std::uint16_t>();
    channel.topic = reader.text();
    channel.encoding = reader.text();
    define(channels_, id, std::move(channel), "channel");
  } else if (op == McapOp::message) {
    const std::size_t topic = topic_of(reader.number<std::uint16_t>());
    (void)reader.number<std::uint32_t>();  // sequence
    const auto time = static_cast<std::int64_t>(reader.number<std::uint64_t>());
    (void)reader.number<std::uint64_t>();  // publish time
    if (is_cut) ++cut_messages_;
    if (!wanted_ || wanted_(topics_.all()[topic].name)) {
      messages_.push_back({topic, time, reader.rest()});
    }
  }
}

void McapReader::read_chunk(std::string_view content, bool is_cut) {
  try {
    chunk_ = records_of(content, is_cut);
  } catch (const InputError&) {
    if (!is_cut) throw;
    chunk_.clear();
  }
  std::string_view rest = chunk_;
  while (rest.size() >= head_bytes) {
    ByteReader record(rest);
    const auto op = static_cast<McapOp>(record.number<std::uint8_t>());
    const auto size = record.number<std::uint64_t>();
    if (size > record.rest().size()) break;
    use(op, record.take(size), is_cut);
    rest = record.rest();
  }
  if (!rest.empty() && !is_cut) throw InputError("its last record ends beyond it");
  std::ranges::stable_sort(messages_, {}, &BagMessage::time);
}

std::size_t McapReader::topic_of(std::uint16_t channel) {
  const auto known = topic_of_channel_.find(channel);
  if (known != topic_of_channel_.end()) return known->second;
  const auto defined = channels_.find(channel);
  if (defined == channels_.end()) {
    throw InputError(fmt::format("a message is of channel {}, which is not defined", channel));
  }
  const Channel& of = defined->second;
  const auto schema = schemas_.find(of.schema);
  BagTopic topic{of.topic, "", of.encoding};
  if (schema != schemas_.end()) {
    topic.type = schema->second.name;
    if (schema->second.encoding == "ros2msg") topic.definition = schema->second.text;
  }
  return topic_of_channel_[channel] = topics_.index_of(topic);
}

/// The checksum of the summary includes the footer up to the checksum.
void McapReader::finish(std::uint64_t footer, std::string_view content) {
  ByteReader reader(content);
  const auto summary = reader.number<std::uint64_t>();
  (void)reader.number<std::uint64_t>();
  const std::uint64_t start = summary == 0 ? offset_ : summary;
  check(reader.number<std::uint32_t>(), start, footer + 16, "the summary");
  std::string magic;
  file_.read(footer + 20, mcap_magic.size(), magic);
  end(magic == mcap_magic ? "" : "the magic bytes at its end are missing");
}

void McapReader::check(std::uint32_t expected, std::uint64_t from, std::uint64_t to,
                       const char* what) const {
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

void McapReader::end(const std::string& missing) {
  is_at_end_ = true;
  if (missing.empty()) return;
  end_missing_ = fmt::format("cut off at byte {}: {}", file_.size(), missing);
}

std::string McapReader::note() const {
  if (end_missing_.empty()) return {};
  return fmt::format("{}: {}{}", file_.name(), end_missing_,
                     cut_messages_ == 0
                         ? std::string()
                         : fmt::format("; {} messages before it were read", cut_messages_));
}

}  // namespace touchdown::logs
