#include "experiments/estimators/registry.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/yaml.hpp"
#include "experiments/estimators/entries.hpp"

namespace touchdown::experiments {

namespace {

const EstimatorEntry* find(std::span<const EstimatorEntry> entries, std::string_view name) {
  const auto found = std::ranges::find(entries, name, &EstimatorEntry::name);
  return found == entries.end() ? nullptr : &*found;
}

}  // namespace

std::span<const EstimatorEntry> estimator_entries() {
  static const std::vector<EstimatorEntry> entries = [] {
    std::vector<EstimatorEntry> all;
    for (const auto& of_file :
         {force_entries(), filter_entries(), observer_entries(), reference_entries()}) {
      all.insert(all.end(), of_file.begin(), of_file.end());
    }
    return all;
  }();
  return entries;
}

std::vector<std::string> estimator_names(std::span<const EstimatorEntry> external) {
  std::vector<std::string> names;
  for (const EstimatorEntry& entry : estimator_entries()) names.push_back(entry.name);
  for (const EstimatorEntry& entry : external) names.push_back(entry.name);
  return names;
}

const EstimatorEntry& estimator_entry(std::string_view name,
                                      std::span<const EstimatorEntry> external) {
  if (const EstimatorEntry* own = find(estimator_entries(), name)) return *own;
  if (const EstimatorEntry* entry = find(external, name)) return *entry;
  const std::vector<std::string> names = estimator_names(external);
  const std::string near = nearest(name, names);
  throw InputError(fmt::format("unknown estimator '{}': expected one of {}{}", name,
                               fmt::join(names, ", "),
                               near.empty() ? "" : fmt::format(" (did you mean '{}'?)", near)));
}

void check_external_names(std::span<const EstimatorEntry> external) {
  for (const EstimatorEntry& entry : external) {
    if (find(estimator_entries(), entry.name) == nullptr) continue;
    throw InputError(
        fmt::format("the name '{}' is taken by one of touchdown's own estimators", entry.name));
  }
}

}  // namespace touchdown::experiments
