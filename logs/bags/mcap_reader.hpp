#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "logs/bags/files.hpp"
#include "logs/bags/message.hpp"
#include "logs/log/mcap.hpp"

namespace touchdown::logs {

/// Reads the messages of an MCAP file (mcap.dev/spec, version 0) in the order of the file, those of
/// a chunk by the time of recording: chunks uncompressed, lz4 or zstd, or messages outside of
/// chunks. It uses neither index nor summary, which can be missing. Checksums are compared where
/// they are given. A file that is cut off is read as far as its records are whole; `note()`
/// describes its end. Errors: `InputError`, with the byte, for malformed records and chunks, for a
/// channel that is not defined, or twice, and for checksums that differ.
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

  void read_record();
  void use(McapOp op, std::string_view content, bool is_cut);
  void read_chunk(std::string_view content, bool is_cut);
  void finish(std::uint64_t footer, std::string_view content);
  void check(std::uint32_t expected, std::uint64_t from, std::uint64_t to, const char* what) const;
  void end(const std::string& missing);
  std::size_t topic_of(std::uint16_t channel);

  RandomFile file_;
  TopicFilter wanted_;
  std::uint64_t offset_ = 0;  ///< of the next record
  bool is_at_end_ = false;
  std::string end_missing_;
  std::uint64_t cut_messages_ = 0;  ///< whole messages of a chunk that is cut off
  std::map<std::uint16_t, Schema> schemas_;
  std::map<std::uint16_t, Channel> channels_;
  BagTopics topics_;
  std::map<std::uint16_t, std::size_t> topic_of_channel_;
  std::string content_;               ///< of the last record …
  std::string chunk_;                 ///< … and the records in it
  std::vector<BagMessage> messages_;  ///< of the last record
  std::size_t next_ = 0;
};

}  // namespace touchdown::logs
