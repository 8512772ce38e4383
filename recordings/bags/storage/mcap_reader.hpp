#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <list>
#include <map>
#include <string>
#include <vector>

#include "recordings/bags/storage/mcap_layout.hpp"
#include "recordings/bags/storage/message.hpp"
#include "recordings/bags/storage/random_file.hpp"

namespace touchdown::recordings {

/// Reads the messages of an MCAP file (mcap.dev/spec, version 0) by the time of recording: chunks
/// uncompressed, lz4 or zstd, or messages outside of chunks, with or without index and summary.
/// Only the chunks of the current time are in memory. Checksums are compared where they are given.
/// A file that is cut off is read as far as its records are whole; `note()` describes its end.
/// Errors (`InputError`, with the byte): malformed records and chunks, checksums that differ, and
/// chunks that are too large together.
class McapReader {
 public:
  /// A topic is read if `wanted` is empty or true for it. `name` is the file's in messages.
  explicit McapReader(const std::filesystem::path& path, TopicFilter wanted = {},
                      const std::string& name = {});

  /// Proceeds to the next message. Returns false at the end.
  bool next(BagMessage& message);

  /// Topics that are defined in what was read so far.
  const std::vector<BagTopic>& topics() const { return topics_; }
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
    std::uint64_t time() const { return entries[next].time; }
  };

  void with_place(const McapPart& part, const std::function<void()>& use) const;
  std::string records_of(const McapPart& part);
  void load(const McapPart& part);
  std::size_t topic_of(std::uint16_t channel);

  RandomFile file_;
  TopicFilter wanted_;
  McapLayout layout_;
  std::vector<BagTopic> topics_;
  std::map<std::uint16_t, std::size_t> topic_of_channel_;
  std::size_t next_part_ = 0;
  std::uint64_t loaded_bytes_ = 0;
  std::list<Loaded> loaded_;
  std::uint64_t cut_messages_ = 0;  ///< whole messages of a part that is cut off
};

}  // namespace touchdown::recordings
