#pragma once

#include <boost/crc.hpp>
#include <cstdint>
#include <map>
#include <ostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace touchdown::recordings {

/// Writes messages in JSON as an MCAP file, version 0 of its format (mcap.dev/spec): chunks that
/// are not compressed, an index of their messages, and a summary at the end, with checksums.
class McapWriter {
 public:
  /// `stream` must outlive the writer.
  explicit McapWriter(std::ostream& stream);

  /// A topic, before its first message; `schema` is a JSON Schema. Returns its number.
  std::uint16_t add_topic(std::string_view topic, std::string_view schema);

  /// `time` in ns. Errors: `Error` when the stream fails.
  void write(std::uint16_t topic, std::uint64_t time, std::string_view json);

  /// To be called once, after the last message. Errors: as above.
  void finish();

 private:
  using Crc32 = boost::crc_32_type;

  /// Message by message: its time, and where it is among the chunk's records.
  using Index = std::vector<std::pair<std::uint64_t, std::uint64_t>>;

  /// Earliest and latest time; zero before the first.
  struct Span {
    std::uint64_t start = 0;
    std::uint64_t end = 0;
    bool is_empty = true;
    void add(std::uint64_t time);
  };

  void emit(std::string_view bytes);
  void finish_chunk();
  std::string statistics() const;

  std::ostream& stream_;
  std::uint64_t position_ = 0;  ///< in the file
  Crc32 crc_;                   ///< of the section so far
  std::string schemas_, channels_, chunk_indexes_;
  std::map<std::uint16_t, std::uint64_t> counts_;  ///< messages by topic
  Span span_;
  std::uint32_t chunks_ = 0;

  std::string chunk_;  ///< records of the one that is being filled
  Span chunk_span_;
  std::map<std::uint16_t, Index> index_;
};

}  // namespace touchdown::recordings
