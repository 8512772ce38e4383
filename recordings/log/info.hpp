#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "recordings/log/packing.hpp"
#include "recordings/recording.hpp"

namespace touchdown::recordings {

/// Appends the origin of a run, `config: {touchdown: {…}}`, to a map that is being packed.
void pack_info(LogPacker& packer, const RecordingInfo& info);

/// Appends the name of a robot that recorded a log, `config: {robot: …}`.
void pack_robot(LogPacker& packer, std::string_view robot);

/// Reads the name of the robot from a record of a robot's log; empty if it has none.
std::string unpack_robot(std::string_view record);

/// Reads `config.touchdown` of a record; empty for a log that touchdown did not write.
/// Errors: `InputError` for invalid values.
std::optional<RecordingInfo> unpack_info(std::string_view record, std::string_view log_name);

}  // namespace touchdown::recordings
