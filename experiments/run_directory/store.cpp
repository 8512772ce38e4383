#include "experiments/run_directory/store.hpp"

#include <array>
#include <fstream>
#include <map>
#include <mutex>
#include <utility>
#include <xxhash.h>

#include <fmt/format.h>

#include "core/files.hpp"
#include "experiments/run_directory/own_files.hpp"

namespace touchdown::experiments {

namespace {

constexpr std::string_view first_line = "touchdown state\n";

std::string head(std::string_view key, std::string_view content) {
  return fmt::format("{}{}\n{} {:016x}\n", first_line, key, content.size(), checksum(content));
}

/// The content of a file, with its key.
struct SavedPart {
  std::string key;
  std::string content;
};

/// Reads a file with any key. Nothing if it is missing or damaged.
std::optional<SavedPart> read_part(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return std::nullopt;
  const std::string file = read_file(path);
  const std::string_view all = file;
  std::array<std::size_t, 4> line = {};
  for (std::size_t i = 1; i < line.size(); ++i) {
    const std::size_t end = all.find('\n', line[i - 1]);
    if (end == std::string_view::npos) return std::nullopt;
    line[i] = end + 1;
  }
  const std::string_view key = all.substr(line[1], line[2] - line[1] - 1);
  const std::string_view content = all.substr(line[3]);
  if (all.substr(0, line[3]) != head(key, content)) return std::nullopt;
  return SavedPart{std::string(key), std::string(content)};
}

}  // namespace

std::uint64_t checksum(std::string_view content) {
  return XXH3_64bits(content.data(), content.size());
}

std::optional<std::uint64_t> file_checksum(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return std::nullopt;
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> sum(XXH3_createState(),
                                                                     XXH3_freeState);
  if (!sum) return std::nullopt;
  XXH3_64bits_reset(sum.get());
  std::vector<char> block(std::size_t{1} << 20U);
  do {
    file.read(block.data(), static_cast<std::streamsize>(block.size()));
    XXH3_64bits_update(sum.get(), block.data(), static_cast<std::size_t>(file.gcount()));
  } while (file);
  if (file.bad()) return std::nullopt;
  return XXH3_64bits_digest(sum.get());
}

struct Store::Memory {
  std::mutex mutex;
  std::map<std::string, std::string, std::less<>> parts;  ///< by key
};

Store::Store() : memory_(std::make_shared<Memory>()) {}

Store::Store(std::filesystem::path run_directory, std::string key)
    : directory_(std::move(run_directory)), key_(std::move(key)) {}

std::optional<std::string> Store::read(std::string_view kind, std::string_view name) const {
  const std::string key = key_of(kind, name);
  if (memory_) {
    const std::scoped_lock lock(memory_->mutex);
    const auto found = memory_->parts.find(key);
    return found == memory_->parts.end() ? std::nullopt : std::optional(found->second);
  }
  std::optional<SavedPart> part = read_part(directory_ / "state" / kind / name);
  if (!part || part->key != key) return std::nullopt;
  return std::move(part->content);
}

void Store::write(std::string_view kind, std::string_view name, std::string_view bytes) const {
  const std::string key = key_of(kind, name);
  if (memory_) {
    const std::scoped_lock lock(memory_->mutex);
    memory_->parts.insert_or_assign(key, std::string(bytes));
    return;
  }
  write_atomically(record_file(directory_, std::filesystem::path("state") / kind / name),
                   head(key, bytes).append(bytes));
}

std::vector<std::string> Store::names(std::string_view kind) const {
  std::vector<std::string> names;
  for (const std::filesystem::path& entry : entries_in(directory_ / "state" / kind)) {
    names.push_back(entry.filename().string());
  }
  return names;
}

std::string Store::key_of(std::string_view kind, std::string_view name) const {
  return fmt::format("{} {} part {}", key_, kind, name);
}

}  // namespace touchdown::experiments
