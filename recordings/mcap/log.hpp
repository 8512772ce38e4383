#pragma once

#include <cstdint>
#include <ostream>

#include "recordings/log/reader.hpp"

namespace touchdown::recordings {

inline constexpr const char* mcap_observation_topic = "/upkie/observation";
inline constexpr const char* mcap_belief_topic = "/touchdown/beliefs";

/// Writes a log as an MCAP file, for Foxglove and other tools. Each row gives its `observation` as
/// JSON, and the beliefs of `touchdown estimate`, if the first row has them. Times are those of the
/// log's own clock; NaN becomes null. Returns the number of rows. Errors: those of the reader;
/// `InputError` for records that cannot be JSON; `Error` when the stream fails.
std::uint64_t write_mcap(LogReader& reader, std::ostream& stream);

}  // namespace touchdown::recordings
