#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "experiments/estimator_registry.hpp"
#include "experiments/log_fit.hpp"

namespace touchdown {

/// What `touchdown fit` was asked for.
struct FitFlags {
  std::vector<std::string> logs;
  std::vector<std::string> contact;
  std::vector<std::string> no_contact;
  std::string output;
  std::string estimator = "robust";
  LogFitConfig config;
  std::vector<int> grid;
  std::vector<double> bandwidth;
  std::vector<double> bandwidth_floor;
  std::vector<double> knee_range;
  std::vector<double> wheel_range;

  bool shapes_grid() const {
    return !grid.empty() || !bandwidth.empty() || !bandwidth_floor.empty() || !knee_range.empty() ||
           !wheel_range.empty();
  }
};

/// Adds the flags, which must outlive the verb.
void add_fit_flags(CLI::App& verb, FitFlags& flags);

/// Errors: `InputError` when there is no log.
std::vector<FitLog> logs_of(const FitFlags& flags);

/// The estimator's filter, its densities shaped as the flags say. Errors: `InputError`.
BayesFilterConfig filter_of(const EstimatorEntry& entry, const FitFlags& flags);

}  // namespace touchdown
