#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/estimators/baselines.hpp"
#include "experiments/estimators/entry.hpp"

namespace touchdown::experiments {

/// All built-in estimators, in the order of tables.
std::span<const EstimatorEntry> estimator_entries();
/// The names of all estimators that an experiment can use: built-in ones, then external ones.
std::vector<std::string> estimator_names();

/// The estimator of this name. Errors: `InputError` with the nearest known name.
const EstimatorEntry& estimator_entry(std::string_view name);

/// Whether the estimator is a reference upper bound; false for unknown names.
bool is_upper_bound(std::string_view estimator);

/// Registers the external estimators of a caller: experiments can use them while this object lives.
/// Errors: `InputError` while another such object lives, and for the name of a built-in estimator.
class ExternalEstimators {
 public:
  explicit ExternalEstimators(std::vector<EstimatorEntry> external_estimators);
  ~ExternalEstimators();
  ExternalEstimators(const ExternalEstimators&) = delete;
  ExternalEstimators& operator=(const ExternalEstimators&) = delete;
};

/// Prefix of the names of estimators written in Python: `python:module.Class`.
inline constexpr std::string_view python_prefix = "python:";

}  // namespace touchdown::experiments
