#include <algorithm>
#include <sstream>

#include "core/error.hpp"
#include "recordings/mapping/conversion.hpp"
#include "tests/fuzz/entry.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::fuzz {

/// A mapping file, a line of dashes, and the log that it maps.
TOUCHDOWN_FUZZ(mapping) {
  static const ScratchFolder folder;
  constexpr std::string_view between = "\n---\n";
  const std::size_t end = std::min(input.find(between), input.size());
  const std::string_view log = input.substr(std::min(end + between.size(), input.size()));
  std::ostringstream stream;
  try {
    (void)recordings::convert_log(folder.write("log.csv", std::string(log)),
                                  folder.write("map.yaml", std::string(input.substr(0, end))),
                                  stream);
  } catch (const Error& error) {
    expected(error, input);
  }
}

}  // namespace touchdown::fuzz
