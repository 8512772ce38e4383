#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "estimator/bayes_filter.hpp"
#include "estimator/contact_estimator.hpp"
#include "estimator/phase_filter_config.hpp"

namespace touchdown {

struct FittedModel;

/// The estimator that every table shows beside the others.
inline constexpr std::string_view always_contact_name = "always_contact";

/// One estimator that an experiment can name: what it has to be fitted with, and how it is made.
struct EstimatorEntry {
  std::string name;
  std::string title;  ///< for tables and figures
  /// The filter configuration whose measurement model it needs, if it needs one.
  std::optional<BayesFilterConfig> config;
  /// The configuration whose phase model it needs, if it needs one.
  std::optional<PhaseFilterConfig> phase;
  /// `model` is null when it needs none.
  std::unique_ptr<ContactEstimator> (*make)(const EstimatorEntry& entry, const FittedModel* model,
                                            double sample_rate);
};

/// Every estimator an experiment can name, in the order of tables.
std::span<const EstimatorEntry> estimator_entries();
std::vector<std::string> estimator_names();

/// Errors: `InputError` naming the nearest one.
const EstimatorEntry& estimator_entry(std::string_view name);

}  // namespace touchdown
