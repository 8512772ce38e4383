#include "experiments/saved_state.hpp"

#include <array>
#include <cstring>
#include <fstream>
#include <vector>

#include <fmt/format.h>

#include "core/files.hpp"

namespace touchdown {

namespace {

/// Takes content in pieces; all but the last are whole blocks.
class Checksum {
 public:
  static constexpr std::size_t block = 32;

  void add(std::string_view piece) {
    size_ += piece.size();
    while (piece.size() >= block) {
      mix(piece.data());
      piece.remove_prefix(block);
    }
    if (piece.empty()) return;
    std::array<char, block> last{};
    std::memcpy(last.data(), piece.data(), piece.size());
    mix(last.data());
  }

  std::uint64_t value() const {
    std::uint64_t sum = size_;
    for (const std::uint64_t lane : lanes_) sum = next(sum, lane);
    return next(sum, sum >> 29U);
  }

 private:
  static std::uint64_t next(std::uint64_t state, std::uint64_t word) {
    state = (state ^ word) * 0x9e3779b97f4a7c15ULL;
    return state ^ (state >> 32U);
  }

  void mix(const char* bytes) {
    for (std::size_t i = 0; i < lanes_.size(); ++i) {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes + i * sizeof word, sizeof word);
      lanes_[i] = next(lanes_[i], word);
    }
  }

  std::array<std::uint64_t, 4> lanes_ = {1, 2, 3, 4};
  std::uint64_t size_ = 0;
};

std::string head(std::string_view key, std::string_view content) {
  return fmt::format("touchdown state\n{}\n{} {:016x}\n", key, content.size(), checksum(content));
}

}  // namespace

std::uint64_t checksum(std::string_view content) {
  Checksum sum;
  sum.add(content);
  return sum.value();
}

std::optional<std::uint64_t> file_checksum(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  std::vector<char> piece(std::size_t{1} << 20U);
  static_assert((std::size_t{1} << 20U) % Checksum::block == 0);
  Checksum sum;
  do {
    file.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    sum.add({piece.data(), static_cast<std::size_t>(file.gcount())});
  } while (file);
  if (file.bad()) return std::nullopt;
  return sum.value();
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
    if (hidden && name.find(".part") != std::string::npos && entry->is_regular_file(ignored)) {
      partial.push_back(entry->path());
    }
  }
  for (const fs::path& path : partial) fs::remove(path, ignored);
}

}  // namespace touchdown
