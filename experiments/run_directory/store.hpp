#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "core/error.hpp"

namespace touchdown::experiments {

/// A fast checksum (XXH3), the same on every machine.
std::uint64_t checksum(std::string_view content);
/// The checksum of a file, read in blocks. Nothing if it cannot be read.
std::optional<std::uint64_t> file_checksum(const std::filesystem::path& path);

/// Whether a text or a list holds its items one after the other, in their memory layout.
template <typename T>
constexpr bool is_block = requires(T list) {
  list.data();
  requires std::is_trivially_copyable_v<typename T::value_type>;
};

template <typename T>
constexpr bool is_array = false;
template <typename T, std::size_t n>
constexpr bool is_array<std::array<T, n>> = true;

/// Appends a value as bytes that only the same build reads: numbers and structs of numbers in their
/// memory layout; texts, lists and maps with their size; other structs by their `members`, a static
/// function that ties them.
template <typename T>
void pack(const T& value, std::string& bytes) {
  if constexpr (requires { T::members(value); }) {
    std::apply([&](const auto&... member) { (pack(member, bytes), ...); }, T::members(value));
  } else if constexpr (requires { value.first; }) {
    pack(value.first, bytes);
    pack(value.second, bytes);
  } else if constexpr (std::is_trivially_copyable_v<T>) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  } else if constexpr (is_array<T>) {
    for (const auto& item : value) pack(item, bytes);
  } else {
    pack(std::uint64_t{value.size()}, bytes);
    if constexpr (is_block<T>) {
      bytes.append(reinterpret_cast<const char*>(value.data()),
                   value.size() * sizeof(*value.data()));
    } else {
      for (const auto& item : value) pack(item, bytes);
    }
  }
}
template <typename T>
std::string pack(const T& value) {
  std::string bytes;
  pack(value, bytes);
  return bytes;
}

/// Reads a value and removes it from the front. Errors: `Error` for too few bytes.
template <typename T>
T unpack(std::string_view& bytes) {
  T value = {};
  if constexpr (requires { T::members(value); }) {
    const auto read = [&](auto& member) { member = unpack<std::decay_t<decltype(member)>>(bytes); };
    std::apply([&](auto&... member) { (read(member), ...); }, T::members(value));
  } else if constexpr (std::is_trivially_copyable_v<T>) {
    if (bytes.size() < sizeof value) throw Error("a saved part is too short");
    std::memcpy(&value, bytes.data(), sizeof value);
    bytes.remove_prefix(sizeof value);
  } else if constexpr (is_array<T>) {
    for (auto& item : value) item = unpack<typename T::value_type>(bytes);
  } else if constexpr (is_block<T>) {
    const auto size = unpack<std::uint64_t>(bytes);
    if (bytes.size() / sizeof(*value.data()) < size) throw Error("a saved part is too short");
    value.resize(size);
    if (size > 0) std::memcpy(value.data(), bytes.data(), size * sizeof(*value.data()));
    bytes.remove_prefix(size * sizeof(*value.data()));
  } else {
    for (auto left = unpack<std::uint64_t>(bytes); left > 0; --left) {
      if constexpr (requires { typename T::mapped_type; }) {
        auto key = unpack<typename T::key_type>(bytes);
        value.emplace(std::move(key), unpack<typename T::mapped_type>(bytes));
      } else {
        value.push_back(unpack<typename T::value_type>(bytes));
      }
    }
  }
  return value;
}

/// The parts of an experiment that are computed already, as bytes by kind and name. A resumed run,
/// a shard and the run that finishes shards ask for the same parts, whichever process computed
/// them. Each file holds a key (experiment, build, kind, name) and a checksum; a file with another
/// key, or a damaged one, counts as missing. Several threads and processes may use the same files
/// at once.
class Store {
 public:
  /// Parts in memory, shared by all copies.
  Store();
  /// Files in `state` of a run directory, in a folder for each kind. `key` identifies the
  /// experiment and the build.
  Store(std::filesystem::path run_directory, std::string key);

  [[nodiscard]] std::optional<std::string> read(std::string_view kind, std::string_view name) const;
  void write(std::string_view kind, std::string_view name, std::string_view bytes) const;

  template <typename T>
  [[nodiscard]] std::optional<T> find(std::string_view kind, std::string_view name) const {
    const std::optional<std::string> bytes = read(kind, name);
    if (!bytes) return std::nullopt;
    std::string_view rest = *bytes;
    return unpack<T>(rest);
  }
  template <typename T>
  void put(std::string_view kind, std::string_view name, const T& value) const {
    write(kind, name, pack(value));
  }
  /// The saved part. If there is none, computes and saves it.
  template <typename T, typename Compute>
  T get(std::string_view kind, std::string_view name, const Compute& compute) const {
    if (std::optional<T> found = find<T>(kind, name)) return *std::move(found);
    T value = compute();
    put(kind, name, value);
    return value;
  }

  /// The names of the files of a kind, sorted; whole, damaged and other ones.
  [[nodiscard]] std::vector<std::string> names(std::string_view kind) const;

 private:
  struct Memory;

  [[nodiscard]] std::string key_of(std::string_view kind, std::string_view name) const;

  std::filesystem::path directory_;
  std::string key_;
  std::shared_ptr<Memory> memory_;  ///< null: files
};

}  // namespace touchdown::experiments
