#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/estimators/baselines.hpp"
#include "experiments/estimators/entry.hpp"

namespace touchdown::experiments {

/// Every estimator of ours, in the order of tables.
std::span<const EstimatorEntry> estimator_entries();
/// Every estimator that an experiment can name: ours, then guests.
std::vector<std::string> estimator_names();

/// One that an experiment can name. Errors: `InputError` naming the nearest one.
const EstimatorEntry& estimator_entry(std::string_view name);

/// False for names that are not in the table.
bool is_upper_bound(std::string_view estimator);

/// Estimators that whoever runs an experiment brings along: it can name them while this lives. One
/// host at a time. Errors: `InputError` while there is another, and for a name that is ours.
class ExternalEstimators {
 public:
  explicit ExternalEstimators(std::vector<EstimatorEntry> external_estimators);
  ~ExternalEstimators();
  ExternalEstimators(const ExternalEstimators&) = delete;
  ExternalEstimators& operator=(const ExternalEstimators&) = delete;
};

/// What the names of estimators begin with that are written in Python: `python:module.Class`.
inline constexpr std::string_view python_prefix = "python:";

}  // namespace touchdown::experiments
