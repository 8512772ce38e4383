#include "experiments/run_directory/shard.hpp"

#include <charconv>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"

namespace touchdown::experiments {

namespace {

std::filesystem::path notes(const std::filesystem::path& run_directory) {
  return run_directory / "state" / "shards";
}

}  // namespace

Shard shard_from(std::string_view text) {
  constexpr int most = 100'000;
  Shard shard{0, 0};
  const char* const end = text.data() + text.size();
  const auto [slash, first_error] = std::from_chars(text.data(), end, shard.index);
  if (first_error == std::errc{} && slash != end && *slash == '/') {
    const auto [rest, second_error] = std::from_chars(slash + 1, end, shard.count);
    if (second_error == std::errc{} && rest == end && shard.index >= 1 &&
        shard.index <= shard.count && shard.count <= most) {
      return shard;
    }
  }
  throw InputError(
      fmt::format("'{}' is no shard: expected k/n with k from 1 to n, for example 1/3", text));
}

std::string to_text(const Shard& shard) { return fmt::format("{}/{}", shard.index, shard.count); }

void note_shard(const std::filesystem::path& run_directory, const Shard& shard) {
  write_atomically(notes(run_directory) / fmt::format("{}_of_{}", shard.index, shard.count),
                   to_text(shard) + "\n");
}

int noted_shards(const std::filesystem::path& run_directory) {
  int count = 1;
  auto newest = std::filesystem::file_time_type::min();
  std::error_code ignored;
  for (const auto& note : std::filesystem::directory_iterator(notes(run_directory), ignored)) {
    if (note.path().filename().string().rfind('.', 0) == 0) continue;
    const auto written = note.last_write_time(ignored);
    if (written < newest) continue;
    std::string text = read_file(note.path());
    while (!text.empty() && text.back() == '\n') text.pop_back();
    count = shard_from(text).count;
    newest = written;
  }
  return count;
}

void remove_shard_notes(const std::filesystem::path& run_directory) {
  std::error_code ignored;
  std::filesystem::remove_all(notes(run_directory), ignored);
}

}  // namespace touchdown::experiments
