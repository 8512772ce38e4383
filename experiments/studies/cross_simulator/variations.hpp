#pragma once

#include <string>
#include <vector>

#include "experiments/plan/plan.hpp"
#include "experiments/studies/cross_simulator/transfer.hpp"

namespace touchdown::experiments {

/// One value of one factor in one engine.
struct Variation {
  std::size_t factor_index = 0;  ///< in the file's list
  std::string factor;
  double value = 0.0;
  double nominal = 0.0;
  std::string simulator;

  bool is_nominal() const { return value == nominal; }
};

/// Every value of every factor, nominal ones included, in each engine of the factor. Errors:
/// `InputError` that names the factor when the scenario has no such key.
std::vector<Variation> variations(const RunRequest& request);

/// Adds the check to an experiment's plan. Estimators that were fitted in the other engine are
/// evaluated, too. Every value but the nominal ones gets a group of runs, evaluated at the first
/// highlighted noise setting. Errors: `InputError` that names the factor and the invalid value.
void add_cross_simulator(const RunRequest& request, Plan& plan);

/// The runs of one value; for a nominal value, the experiment's own first test runs.
std::vector<std::size_t> runs_of(const Variation& variation, const RunRequest& request,
                                 const Plan& plan);

}  // namespace touchdown::experiments
