#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "recordings/bags/storage/mcap_records.hpp"
#include "recordings/bags/storage/random_file.hpp"

namespace touchdown::recordings {

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
  std::string profile;      ///< "ros2"
  std::string end_missing;  ///< what is missing at the end of a file cut off; empty if nothing is
};

/// Finds the parts of a file. It reads the heads of records, not their messages, and uses neither
/// index nor summary, which can be missing. Errors: `InputError` that names the byte for
/// - a file without the magic bytes of MCAP;
/// - a malformed record;
/// - a checksum of the data section or of the summary that differs.
McapLayout mcap_layout(const RandomFile& file);

}  // namespace touchdown::recordings
