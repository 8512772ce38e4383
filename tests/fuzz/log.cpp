#include <algorithm>
#include <sstream>
#include <string>

#include "core/error.hpp"
#include "logs/log/annotator.hpp"
#include "logs/log/reader.hpp"
#include "logs/signals_from.hpp"
#include "tests/fuzz/entry.hpp"

namespace touchdown::fuzz {

namespace {

/// Reads a log as `touchdown estimate` does and writes beliefs into it. `chunk` is the number of
/// bytes per read, as from a live stream; 0: all.
struct Annotated {
  std::size_t rows = 0;
  std::string log;
};

Annotated annotated(std::string_view bytes, std::size_t chunk) {
  const logs::ByteSource source = [&](std::span<char> buffer) {
    const std::size_t most = chunk == 0 ? buffer.size() : std::min(buffer.size(), chunk);
    const std::size_t size = bytes.copy(buffer.data(), most);
    bytes.remove_prefix(size);
    return size;
  };
  logs::LogReader reader(source, "fuzz.mpack");
  (void)reader.info();
  std::ostringstream out;
  logs::LogAnnotator annotator(out);
  Annotated result;
  while (const std::optional<logs::LogRow> row = reader.next()) {
    (void)logs::signals_from(row->observation, logs::ground_velocity_command(row->action));
    annotator.copy(reader.skipped());
    annotator.annotate(reader.record(), {}, {});
    ++result.rows;
  }
  annotator.copy(reader.skipped());
  result.log = out.str();
  return result;
}

}  // namespace

/// A log, annotated and read again. The first byte times 16 is the chunk size.
TOUCHDOWN_FUZZ(log) {
  if (input.empty()) return;
  const auto chunk = 16 * static_cast<std::size_t>(static_cast<unsigned char>(input.front()));
  Annotated once;
  try {
    once = annotated(input.substr(1), chunk);
  } catch (const Error& error) {
    expected(error, input);
    return;
  }
  if (once.rows != 0 && annotated(once.log, 0).rows != once.rows) __builtin_trap();
}

}  // namespace touchdown::fuzz
