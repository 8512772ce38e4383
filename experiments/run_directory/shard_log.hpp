#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/run_directory/shard.hpp"

namespace touchdown::experiments {

/// Which shards a run directory's work was cut into: each leaves a note when it starts, so that
/// `merge` can say which ones are missing. The notes are removed once all is merged.
void note_shard(const std::filesystem::path& run_directory, const Shard& shard);
/// Number of shards of the newest note; 1 without any.
int noted_shards(const std::filesystem::path& run_directory);
void remove_shard_notes(const std::filesystem::path& run_directory);

}  // namespace touchdown::experiments
