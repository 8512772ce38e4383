#include "experiments/studies/ablation/estimators.hpp"

#include <string>

#include <fmt/format.h>

#include "estimator/bayes/ablation.hpp"
#include "experiments/estimators/entries.hpp"

namespace touchdown::experiments {

namespace {

constexpr const char* hmm_without_memory = "hmm_without_memory";

EstimatorEntry hmm_without_memory_entry() {
  EstimatorEntry entry = hmm_entry();
  entry.name = hmm_without_memory;
  entry.title = hmm_without_memory;
  entry.summary = "Runs the two-state HMM with uniform transition probabilities";
  entry.reason = "ablation of the phase filter";
  entry.phase->fit.pseudo_count = 1e12;
  return entry;
}

}  // namespace

std::vector<EstimatorEntry> ablation_estimators() {
  std::vector<EstimatorEntry> entries;
  std::string before = "paper";
  for (const AblationStep& step : steps_from_paper_to_robust()) {
    entries.push_back(
        bayes_entry(step.name,
                    fmt::format("Runs `{}` with {}, an ablation step from paper to robust", before,
                                step.change),
                    "ablation of the paper's filter", step.config));
    entries.back().title = step.name;  // as tables name estimators outside the registry
    before = step.name;
  }
  entries.push_back(hmm_without_memory_entry());
  return entries;
}

}  // namespace touchdown::experiments
