#pragma once

#include <optional>
#include <string_view>

#include "recordings/log/packing.hpp"
#include "recordings/recording.hpp"

namespace touchdown::recordings {

/// Appends `config: {touchdown: {…}}` to a map that is being packed: where the run comes from.
void pack_info(LogPacker& packer, const RecordingInfo& info);

/// What `config.touchdown` of a record says; nothing if it was not written by us.
/// Errors: `InputError` when it says something that we do not understand.
std::optional<RecordingInfo> unpack_info(std::string_view record, std::string_view log_name);

}  // namespace touchdown::recordings
