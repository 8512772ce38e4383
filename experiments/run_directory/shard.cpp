#include "experiments/run_directory/shard.hpp"

#include <optional>
#include <regex>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/machine.hpp"

namespace touchdown::experiments {

namespace fs = std::filesystem;

namespace {

fs::path mark_folder(const fs::path& run_directory) { return run_directory / "state" / "shards"; }

/// Two whole numbers with `between` between them; nothing for another text.
std::optional<Shard> read_shard(const std::string& text, const char* between) {
  const std::regex shape(fmt::format(R"((\d{{1,6}}){}(\d{{1,6}}))", between));
  std::smatch part;
  if (!std::regex_match(text, part, shape)) return std::nullopt;
  return Shard{std::stoi(part[1]), std::stoi(part[2])};
}

/// The marks of started shards, with their files.
std::vector<std::pair<fs::path, Shard>> marks_in(const fs::path& run_directory) {
  std::vector<std::pair<fs::path, Shard>> found;
  for (const fs::path& mark : entries_in(mark_folder(run_directory))) {
    const std::optional<Shard> shard = read_shard(mark.filename().string(), "_of_");
    if (shard) found.emplace_back(mark, *shard);
  }
  return found;
}

}  // namespace

Shard shard_from(const std::string& text) {
  constexpr int most = 100'000;
  const std::optional<Shard> shard = read_shard(text, "/");
  if (shard && shard->index >= 1 && shard->index <= shard->count && shard->count <= most) {
    return *shard;
  }
  throw InputError(
      fmt::format("'{}' is no shard: expected k/n with k from 1 to n, for example 1/3", text));
}

std::string to_text(const Shard& shard) { return fmt::format("{}/{}", shard.index, shard.count); }

void mark_shard_started(const fs::path& run_directory, const Shard& shard) {
  write_atomically(mark_folder(run_directory) / fmt::format("{}_of_{}", shard.index, shard.count),
                   processor_class() + "\n");
}

int started_shards(const fs::path& run_directory) {
  int count = 1;
  auto newest = fs::file_time_type::min();
  std::error_code ignored;
  for (const auto& [path, shard] : marks_in(run_directory)) {
    const auto written = fs::last_write_time(path, ignored);
    if (written < newest) continue;
    count = shard.count;
    newest = written;
  }
  return count;
}

std::set<std::string> shard_processors(const fs::path& run_directory) {
  std::set<std::string> classes;
  for (const auto& [path, shard] : marks_in(run_directory)) {
    std::string name = read_file(path);
    name.erase(name.find_last_not_of('\n') + 1);
    classes.insert(std::move(name));
  }
  return classes;
}

void remove_shard_marks(const fs::path& run_directory) {
  std::error_code ignored;
  for (const auto& [path, shard] : marks_in(run_directory)) fs::remove(path, ignored);
  fs::remove(mark_folder(run_directory), ignored);
}

}  // namespace touchdown::experiments
