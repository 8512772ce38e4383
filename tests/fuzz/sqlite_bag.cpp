#include <fstream>

#include "core/error.hpp"
#include "logs/bags/sqlite_reader.hpp"
#include "tests/fuzz/entry.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::fuzz {

/// A SQLite bag. SQLite needs a file with a name.
TOUCHDOWN_FUZZ(sqlite_bag) {
  static const ScratchFolder folder;
  const std::filesystem::path path = folder / "bag.db3";
  std::ofstream(path, std::ios::binary) << input;
  try {
    logs::SqliteReader reader(path);
    logs::BagMessage message;
    std::size_t bytes = 0;
    while (reader.next(message)) {
      for (const char c : message.data) bytes += static_cast<unsigned char>(c);
    }
    if (bytes == 1 && reader.note().empty()) return;  // the data were read
  } catch (const Error& error) {
    expected(error, input);
  }
}

}  // namespace touchdown::fuzz
