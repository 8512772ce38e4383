#pragma once

#include <string>
#include <vector>

#include "experiments/studies/cross_simulator/transfer.hpp"
#include "experiments/plan/plan.hpp"

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

/// Every value of every factor, nominal ones included, in each engine where it means something.
/// Errors: `InputError` naming the factor when the scenario has no such key.
std::vector<Variation> variations(const RunRequest& request);

/// What the check adds to an experiment's plan: estimators that were fitted in the other engine
/// listen too, and every value but the nominal ones has a group of runs, which is listened to at
/// the first highlighted noise setting. Errors: `InputError` naming the factor and the value that
/// the scenario refuses.
void add_cross_simulator(const RunRequest& request, Plan& plan);

/// The runs of one value; of a nominal one, the experiment's own first test runs.
std::vector<std::size_t> runs_of(const Variation& variation, const RunRequest& request,
                                 const Plan& plan);

}  // namespace touchdown::experiments
