#pragma once

#include <cstdint>
#include <functional>
#include <ostream>
#include <string>
#include <string_view>

#include "recordings/log/reader.hpp"
#include "recordings/mcap/writer.hpp"

namespace touchdown::recordings {

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

}  // namespace touchdown::recordings
