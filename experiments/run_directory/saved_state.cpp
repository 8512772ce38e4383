#include "experiments/run_directory/saved_state.hpp"

#include <array>
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

void write_state(const std::filesystem::path& path, std::string_view key,
                 std::string_view content) {
  write_atomically(path, head(key, content).append(content));
}

std::optional<std::string> read_state(const std::filesystem::path& path, std::string_view key) {
  std::optional<SavedState> state = read_any_state(path);
  if (!state || state->key != key) return std::nullopt;
  return std::move(state->content);
}

std::optional<SavedState> read_any_state(const std::filesystem::path& path) {
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
  return SavedState{std::string(key), std::string(content)};
}

}  // namespace touchdown::experiments
