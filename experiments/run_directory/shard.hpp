#pragma once

#include <cstddef>
#include <filesystem>
#include <set>
#include <string>

namespace touchdown::experiments {

/// The part of an experiment that one of `count` processes computes: the `index`-th, from 1.
struct Shard {
  int index = 1;
  int count = 1;

  /// Its share of `size` items is [begin, end). The shares of all shards cover all items without
  /// overlap.
  std::size_t begin(std::size_t size) const {
    return size * (static_cast<std::size_t>(index) - 1) / static_cast<std::size_t>(count);
  }
  std::size_t end(std::size_t size) const {
    return size * static_cast<std::size_t>(index) / static_cast<std::size_t>(count);
  }

  friend bool operator==(const Shard&, const Shard&) = default;
};

/// Reads "2/3". Errors: `InputError` unless it is k/n with 1 ≤ k ≤ n ≤ 100,000.
Shard shard_from(const std::string& text);
std::string to_text(const Shard& shard);

/// Marks a shard as started in its run directory, so that `merge` can name missing shards, and
/// those of other processors, which compute other last digits. The marks are removed after the
/// merge.
void mark_shard_started(const std::filesystem::path& run_directory, const Shard& shard);
/// Number of shards by the newest mark; 1 without any.
int started_shards(const std::filesystem::path& run_directory);
/// The classes of the processors on which shards started (core/machine.hpp).
std::set<std::string> shard_processors(const std::filesystem::path& run_directory);
void remove_shard_marks(const std::filesystem::path& run_directory);

}  // namespace touchdown::experiments
