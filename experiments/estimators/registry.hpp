#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/estimators/baselines.hpp"
#include "experiments/estimators/entry.hpp"

namespace touchdown::experiments {

/// All built-in estimators, in the order of tables.
std::span<const EstimatorEntry> estimator_entries();
/// The names of all built-in estimators, then of these external ones.
std::vector<std::string> estimator_names(std::span<const EstimatorEntry> external = {});

/// The estimator of this name, built-in or one of these external ones. Errors: `InputError` with
/// the nearest known name.
const EstimatorEntry& estimator_entry(std::string_view name,
                                      std::span<const EstimatorEntry> external = {});

/// Errors: `InputError` for an external estimator with the name of a built-in one.
void check_external_names(std::span<const EstimatorEntry> external);

/// Prefix of the names of estimators written in Python: `python:module.Class`.
inline constexpr std::string_view python_prefix = "python:";

/// The names of these sensors: "knee_torque", …
std::vector<std::string> names_of(const Sensors& sensors);
/// The sensors of these names. Errors: `InputError`, which begins with `source`, for another name.
Sensors sensors_named(const std::vector<std::string>& names, const std::string& source);

/// The estimators written in Python that a run directory's manifest describes, to show its results:
/// they cannot be run. None without a manifest. Errors: `InputError` for a broken one.
std::vector<EstimatorEntry> written_estimators(const std::filesystem::path& run_directory);

}  // namespace touchdown::experiments
