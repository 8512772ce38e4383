#pragma once

#include <cstddef>
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

}  // namespace touchdown::experiments
