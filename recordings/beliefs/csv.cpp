#include "recordings/beliefs/csv.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "recordings/beliefs/numbers_csv.hpp"

namespace touchdown::recordings {

Beliefs read_belief_csv(const std::filesystem::path& path) {
  BeliefColumns columns;
  columns.beliefs.file = path.string();
  read_numbers_csv(path,
                   {[&](std::span<const std::string> names) { return columns.set_names(names); },
                    [&](std::span<const double> values, std::size_t line) {
                      std::optional<ColumnError> wrong = columns.add(values);
                      if (!wrong) columns.beliefs.line.push_back(line);
                      return wrong;
                    }});
  if (columns.beliefs.size() == 0) {
    throw InputError(fmt::format("{}:1:1: holds no beliefs", path.string()));
  }
  return std::move(columns.beliefs);
}

}  // namespace touchdown::recordings
