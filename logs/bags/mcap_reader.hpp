#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "logs/bags/compression.hpp"
#include "logs/bags/files.hpp"
#include "logs/bags/message.hpp"
#include "logs/log/mcap.hpp"

namespace touchdown::logs {

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
  struct Schema {
    std::string name;
    std::string encoding;
    std::string text;
    bool operator==(const Schema&) const = default;
  };
  std::map<std::uint16_t, Schema> schema;
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

/// Calls `use` for each record. Returns the number of bytes of whole records.
std::size_t for_each_mcap_record(std::string_view bytes,
                                 const std::function<void(McapOp, std::string_view content)>& use);

/// A part of an MCAP file with messages: one chunk, or some records outside of chunks.
struct McapPart {
  std::uint64_t offset = 0;  ///< of a chunk's content, or of the first record
  std::uint64_t size = 0;    ///< bytes that are there
  std::uint64_t start = 0;   ///< earliest time of its messages (ns)
  bool is_chunk = false;
  bool is_cut = false;  ///< the file ends within it
};

/// Where an MCAP file has its messages.
struct McapLayout {
  std::vector<McapPart> parts;  ///< by start
  bool is_in_file_order = true;
  McapChannels channels;    ///< those outside of chunks
  std::string end_missing;  ///< what is missing at the end of a file cut off; empty if nothing is
};

/// Finds the parts of a file. It reads the heads of records, not their messages, and uses neither
/// index nor summary, which can be missing. Errors: `InputError` that names the byte for
/// - a file without the magic bytes of MCAP;
/// - a malformed record;
/// - a checksum of the data section or of the summary that differs.
McapLayout mcap_layout(const RandomFile& file);

/// Reads the messages of an MCAP file (mcap.dev/spec, version 0) by the time of recording: chunks
/// uncompressed, lz4 or zstd, or messages outside of chunks, with or without index and summary.
/// Only the chunks of the current time are in memory. Checksums are compared where they are given.
/// A file that is cut off is read as far as its records are whole; `note()` describes its end.
/// Errors (`InputError`, with the byte): malformed records and chunks, checksums that differ, and
/// chunks that are too large together.
class McapReader {
 public:
  /// A topic is read if `wanted` is empty or true for it. `name` is the file's in messages. Reading
  /// ends with `Stopped` once `stop` is true; it may be null.
  explicit McapReader(const std::filesystem::path& path, TopicFilter wanted = {},
                      const std::string& name = {}, const std::atomic<bool>* stop = nullptr);

  /// Proceeds to the next message. Returns false at the end.
  bool next(BagMessage& message);

  /// Topics that are defined in what was read so far.
  const std::vector<BagTopic>& topics() const { return topics_.all(); }
  /// What is missing at the end of a file that is cut off, or empty.
  std::string note() const;

 private:
  struct Entry {
    std::uint64_t time = 0;
    std::size_t topic = 0;
    std::size_t offset = 0;
    std::size_t size = 0;
  };
  /// A part in memory.
  struct Loaded {
    std::string bytes;
    std::vector<Entry> entries;  ///< by time
    std::size_t next = 0;
    bool is_done() const { return next == entries.size(); }
  };
  /// Time of the next message; offset of the part.
  using Place = std::pair<std::uint64_t, std::uint64_t>;

  void with_place(const McapPart& part, const std::function<void()>& use) const;
  std::string records_of(const McapPart& part);
  void load(const McapPart& part);
  void leave_last_message();
  std::size_t topic_of(std::uint16_t channel);

  RandomFile file_;
  TopicFilter wanted_;
  McapLayout layout_;
  BagTopics topics_;
  std::map<std::uint16_t, std::size_t> topic_of_channel_;
  std::size_t next_part_ = 0;
  std::uint64_t loaded_bytes_ = 0;
  std::map<Place, Loaded> loaded_;
  bool is_first_read_ = false;      ///< the first loaded part has the last message
  std::uint64_t cut_messages_ = 0;  ///< whole messages of a part that is cut off
};

}  // namespace touchdown::logs
