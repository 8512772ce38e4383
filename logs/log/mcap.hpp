#pragma once

#include <boost/crc.hpp>
#include <cstdint>
#include <functional>
#include <map>
#include <ostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "logs/log/reader.hpp"

namespace touchdown::logs {

inline constexpr std::string_view mcap_magic("\x89MCAP0\r\n", 8);

/// Opcodes of records; mcap.dev/spec, format version 0.
enum class McapOp : std::uint8_t {
  invalid = 0x00,
  header = 0x01,
  footer = 0x02,
  schema = 0x03,
  channel = 0x04,
  message = 0x05,
  chunk = 0x06,
  message_index = 0x07,
  chunk_index = 0x08,
  statistics = 0x0b,
  summary_offset = 0x0e,
  data_end = 0x0f,
};

/// CRC-32 as MCAP uses it.
std::uint32_t mcap_crc(std::string_view bytes);

/// The encoding of a topic's schema and of its messages.
struct McapEncoding {
  std::string_view schema = "jsonschema";
  std::string_view message = "json";
};

/// Writes messages as an MCAP file, format version 0 (mcap.dev/spec): uncompressed chunks, an
/// index of their messages, and a summary at the end, with checksums.
class McapWriter {
 public:
  /// `stream` must outlive the writer. `profile`: "ros2" for messages of ROS 2.
  explicit McapWriter(std::ostream& stream, std::string_view profile = {});

  /// Adds a topic with the schema of its messages. Returns the number of the topic.
  std::uint16_t add_topic(std::string_view topic, std::string_view schema_name,
                          std::string_view schema, const McapEncoding& encoding = {});

  /// `time` in ns. Errors: `Error` when the stream fails.
  void write(std::uint16_t topic, std::uint64_t time, std::string_view message);

  /// Ends the file. Call it once, after the last message. Errors: as above.
  void finish();

 private:
  /// Time of each message, and its offset in the chunk's records.
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
  boost::crc_32_type crc_;      ///< of the section so far
  std::string schemas_, channels_, chunk_indexes_;
  std::map<std::uint16_t, std::uint64_t> counts_;  ///< messages by topic
  Span span_;
  std::uint32_t chunks_ = 0;

  std::string chunk_;  ///< records of the current chunk
  Span chunk_span_;
  std::map<std::uint16_t, Index> index_;
};

inline constexpr const char* mcap_observation_topic = "/upkie/observation";
inline constexpr const char* mcap_belief_topic = "/touchdown/beliefs";

/// Adds messages after those of a row. `row` counts from 0; `time` in ns.
using AddMessages = std::function<void(McapWriter& writer, std::uint64_t row, std::uint64_t time)>;

/// Writes a log as an MCAP file, for Foxglove and other tools. Each row gives its `observation` as
/// JSON, and the beliefs of `touchdown estimate`, if the first row has them. Times are those of the
/// log's own clock; NaN becomes null. Returns the number of rows. Errors: those of the reader;
/// `InputError` for records that cannot be JSON; `Error` when the stream fails.
std::uint64_t write_mcap(LogReader& reader, std::ostream& stream, const AddMessages& add = {});

/// The JSON Schema of messages like this one.
std::string json_schema_of(std::string_view message);

}  // namespace touchdown::logs
