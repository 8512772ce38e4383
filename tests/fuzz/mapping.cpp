#include <algorithm>
#include <sstream>

#include "core/error.hpp"
#include "logs/mapping/conversion.hpp"
#include "tests/fuzz/entry.hpp"
#include "tests/fuzz/memory_file.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::fuzz {

namespace {

/// A file in memory with a name, which decides the format.
class NamedMemoryFile {
 public:
  explicit NamedMemoryFile(const std::filesystem::path& path) : path_(path) {
    std::filesystem::create_symlink(memory_.path(), path);
  }
  const std::filesystem::path& with(std::string_view content) {
    memory_.set_content(content);
    return path_;
  }

 private:
  MemoryFile memory_;
  std::filesystem::path path_;
};

}  // namespace

/// A mapping file, a line of dashes, and the log that it maps.
TOUCHDOWN_FUZZ(mapping) {
  static const ScratchFolder folder;
  static NamedMemoryFile log(folder / "log.csv");
  static NamedMemoryFile mapping(folder / "map.yaml");
  constexpr std::string_view between = "\n---\n";
  const std::size_t end = std::min(input.find(between), input.size());
  const std::string_view rows = input.substr(std::min(end + between.size(), input.size()));
  std::ostringstream stream;
  try {
    (void)logs::convert_log(log.with(rows), mapping.with(input.substr(0, end)), stream);
  } catch (const Error& error) {
    expected(error, input);
  }
}

}  // namespace touchdown::fuzz
