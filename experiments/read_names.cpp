#include "experiments/read_names.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace touchdown {

void read_names(YamlMap& map, std::string_view key, const std::vector<std::string>& known,
                std::vector<std::string>& names) {
  map.read(key, names);
  if (names.empty()) map.fail(key, "expected at least one name");
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (std::find(known.begin(), known.end(), names[i]) == known.end()) {
      std::string message = fmt::format("'{}' is not one of {}", names[i], fmt::join(known, ", "));
      if (const std::string near = nearest(names[i], known); !near.empty()) {
        message += fmt::format(" (did you mean '{}'?)", near);
      }
      map.fail(key, message);
    }
    if (std::find(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(i), names[i]) !=
        names.begin() + static_cast<std::ptrdiff_t>(i)) {
      map.fail(key, fmt::format("'{}' stands there twice", names[i]));
    }
  }
}

}  // namespace touchdown
