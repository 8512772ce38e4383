#include "experiments/run_directory/saved_state.hpp"

#include <fstream>
#include <memory>
#include <vector>
#include <xxhash.h>

#include <fmt/format.h>

#include "core/files.hpp"

namespace touchdown::experiments {

namespace {

std::string head(std::string_view key, std::string_view content) {
  return fmt::format("touchdown state\n{}\n{} {:016x}\n", key, content.size(), checksum(content));
}

}  // namespace

std::uint64_t checksum(std::string_view content) {
  return XXH3_64bits(content.data(), content.size());
}

std::optional<std::uint64_t> file_checksum(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> sum(XXH3_createState(),
                                                                     XXH3_freeState);
  if (!sum) return std::nullopt;
  XXH3_64bits_reset(sum.get());
  std::vector<char> piece(std::size_t{1} << 20U);
  do {
    file.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    XXH3_64bits_update(sum.get(), piece.data(), static_cast<std::size_t>(file.gcount()));
  } while (file);
  if (file.bad()) return std::nullopt;
  return XXH3_64bits_digest(sum.get());
}

void write_state(const std::filesystem::path& path, std::string_view key,
                 std::string_view content) {
  write_atomically(path, head(key, content).append(content));
}

std::optional<std::string> read_state(const std::filesystem::path& path, std::string_view key) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return std::nullopt;
  std::string file = read_file(path);
  const std::string_view all = file;
  std::size_t start = 0;
  for (int line = 0; line < 3; ++line) {
    const std::size_t end = all.find('\n', start);
    if (end == std::string_view::npos) return std::nullopt;
    start = end + 1;
  }
  const std::string_view content = all.substr(start);
  if (all.substr(0, start) != head(key, content)) return std::nullopt;
  return std::string(content);
}

void remove_partial_files(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  std::vector<fs::path> partial;
  for (fs::recursive_directory_iterator entry(folder, ignored), end; entry != end;
       entry.increment(ignored)) {
    const std::string name = entry->path().filename().string();
    const bool hidden = name.rfind('.', 0) == 0;
    if (hidden && name.find(".part") != std::string::npos) {
      partial.push_back(entry->path());
      entry.disable_recursion_pending();
    }
  }
  for (const fs::path& path : partial) fs::remove_all(path, ignored);
}

}  // namespace touchdown::experiments
