#pragma once

#include <filesystem>

#include "recordings/beliefs/beliefs.hpp"

namespace touchdown::recordings {

/// Reads beliefs as a sequence of MessagePack dictionaries, like Upkie's logs: one per step, with
/// numbers (decisions also as booleans) by name. Errors: `InputError` that names the file and the
/// dictionary, counted from 0.
Beliefs read_belief_mpack(const std::filesystem::path& path);

}  // namespace touchdown::recordings
