#pragma once

#include <cstdint>
#include <ostream>

#include "recordings/log/reader.hpp"

namespace touchdown::recordings {

inline constexpr const char* mcap_observation_topic = "/upkie/observation";
inline constexpr const char* mcap_belief_topic = "/touchdown/beliefs";

/// Writes a log as an MCAP file, for Foxglove and others: of each row `observation` as JSON, and
/// beside it, if the first row has them, the beliefs that `estimate` wrote into the log. Times are
/// those of the log's own clock; what is NaN is null. Returns the number of rows. Errors: those of
/// the reader; `InputError` for records that cannot be JSON; `Error` when the stream fails.
std::uint64_t write_mcap(LogReader& reader, std::ostream& stream);

}  // namespace touchdown::recordings
