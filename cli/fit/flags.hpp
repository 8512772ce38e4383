#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "experiments/estimators/entry.hpp"
#include "experiments/logs/fit_log.hpp"

namespace touchdown::cli {

/// What `touchdown fit` was asked for.
struct FitFlags {
  std::vector<std::string> logs;
  std::vector<std::string> contact;
  std::vector<std::string> no_contact;
  std::string output;
  std::string estimator = "robust";
  experiments::LogFitConfig config;
  std::vector<int> grid;
  std::vector<double> bandwidth;
  std::vector<double> bandwidth_floor;
  std::vector<double> knee_range;
  std::vector<double> wheel_range;
};

/// Adds the flags, which must outlive the verb.
void add_fit_flags(CLI::App& verb, FitFlags& flags);

/// Errors: `InputError` when there is no log.
std::vector<experiments::FitLog> logs_of(const FitFlags& flags);

/// Shapes the estimator's densities as the flags say. Errors: `InputError`.
void shape_densities(experiments::EstimatorEntry& entry, const FitFlags& flags);

/// "robust, reference, … or phase".
std::string fitted_estimators();

}  // namespace touchdown::cli
