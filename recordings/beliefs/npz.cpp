#include "recordings/beliefs/npz.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "estimator/npz/npz.hpp"

namespace touchdown::recordings {

Beliefs read_belief_npz(const std::filesystem::path& path) {
  const std::vector<std::string> names = npz_names(path);
  BeliefColumns columns;
  columns.beliefs.file = path.string();
  if (const std::optional<ColumnError> wrong = columns.set_names(names)) {
    throw InputError(fmt::format("{}: {}", path.string(), wrong->what));
  }
  const ModelArrays arrays = read_npz(path);
  const std::size_t steps = arrays.at("time").data.size();
  for (const auto& [name, array] : arrays) {
    if (array.shape.size() == 1 && array.data.size() == steps) continue;
    throw InputError(fmt::format("{}: {}: expected one axis of {}, the steps of 'time'",
                                 path.string(), name, steps));
  }
  if (steps == 0) throw InputError(fmt::format("{}: holds no beliefs", path.string()));
  std::vector<double> values(names.size());
  for (std::size_t step = 0; step < steps; ++step) {
    for (std::size_t i = 0; i < names.size(); ++i) values[i] = arrays.at(names[i]).data[step];
    if (const std::optional<ColumnError> wrong = columns.add(values)) {
      throw InputError(fmt::format("{}: index {}: {}", path.string(), step, wrong->what));
    }
  }
  return std::move(columns.beliefs);
}

}  // namespace touchdown::recordings
