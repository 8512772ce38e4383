#include "experiments/estimators/registry.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/yaml.hpp"
#include "experiments/estimators/decision.hpp"
#include "experiments/estimators/filters.hpp"
#include "experiments/estimators/forces.hpp"

namespace touchdown::experiments {

std::span<const EstimatorEntry> estimator_entries() {
  static const std::vector<EstimatorEntry> entries = {
      bayes_entry("robust", "the paper's filter, made to stand sensor noise",
                  BayesFilterConfig::robust()),
      bayes_entry("reference", "the paper's filter as its authors' robot code has it",
                  BayesFilterConfig::reference()),
      bayes_entry("paper", "the paper's filter to the letter", BayesFilterConfig::paper()),
      bayes_entry("paper_rms", "the paper's filter, its power read as a root mean square",
                  BayesFilterConfig::paper_rms()),
      measurement_only_entry(),
      phase_entry(),
      hmm_entry(),
      hmm_without_memory_entry(),
      neural_entry(),
      upkie_observer_entry(),
      free_fall_entry(),
      support_force_entry(),
      load_logistic_entry(),
      force_kinematics_entry(),
      decision_network_entry(),
      oracle_entry(),
      always_contact_entry(),
  };
  return entries;
}

std::vector<std::string> estimator_names() {
  std::vector<std::string> names;
  for (const EstimatorEntry& entry : estimator_entries()) names.push_back(entry.name);
  return names;
}

const EstimatorEntry& estimator_entry(std::string_view name) {
  const std::span<const EstimatorEntry> entries = estimator_entries();
  const auto found = std::find_if(entries.begin(), entries.end(),
                                  [&](const EstimatorEntry& entry) { return entry.name == name; });
  if (found != entries.end()) return *found;
  const std::string near = nearest(name, estimator_names());
  throw InputError(fmt::format("unknown estimator '{}': expected one of {}{}", name,
                               fmt::join(estimator_names(), ", "),
                               near.empty() ? "" : fmt::format(" (did you mean '{}'?)", near)));
}

}  // namespace touchdown::experiments
