#include "core/error.hpp"
#include "logs/bags/mcap_reader.hpp"
#include "tests/fuzz/entry.hpp"
#include "tests/fuzz/memory_file.hpp"

namespace touchdown::fuzz {

/// An MCAP file.
TOUCHDOWN_FUZZ(mcap) {
  const MemoryFile file(input);
  try {
    logs::McapReader reader(file.path());
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
