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
  static const std::vector<EstimatorEntry> entries = {
      bayes_entry("robust", "Runs the paper's Bayes filter with changes for noisy sensors",
                  "history: the paper's filter, for noisy sensors", BayesFilterConfig::robust()),
      bayes_entry("reference", "Runs the paper's Bayes filter as in the authors' robot code",
                  "history: the authors' robot code", BayesFilterConfig::reference()),
      bayes_entry("paper", "Runs the paper's Bayes filter exactly as published",
                  "history: the paper's filter", BayesFilterConfig::paper()),
      bayes_entry("paper_rms",
                  "Runs the paper's Bayes filter with the power read as a root mean square",
                  "history: another reading of the paper's filter", BayesFilterConfig::paper_rms()),
      measurement_only_entry(),
      phase_entry(),
      hmm_entry(),
      neural_entry(),
      retrained_neural_entry(),
      upkie_observer_entry(),
      free_fall_entry(),
      support_force_entry(),
      force_kinematics_entry(),
      decision_network_entry(),
      evidence_curves_entry(),
      quiet_evidence_curves_entry(),
      shipped_curves_entry(),
      quiet_shipped_curves_entry(),
      boosted_channels_entry(),
      boosted_signals_entry(),
      oracle_entry(),
      always_contact_entry(),
  };
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

bool is_upper_bound(std::string_view estimator) {
  const std::span<const EstimatorEntry> entries = estimator_entries();
  return std::any_of(entries.begin(), entries.end(), [&](const EstimatorEntry& entry) {
    return entry.is_upper_bound && entry.name == estimator;
  });
}

void check_external_names(std::span<const EstimatorEntry> external) {
  for (const EstimatorEntry& entry : external) {
    if (find(estimator_entries(), entry.name) == nullptr) continue;
    throw InputError(
        fmt::format("the name '{}' is taken by one of touchdown's own estimators", entry.name));
  }
}

}  // namespace touchdown::experiments
