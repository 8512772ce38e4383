#pragma once

#include <string>
#include <vector>

#include "core/interval.hpp"
#include "experiments/cross_simulator/variations.hpp"
#include "experiments/listening/tasks.hpp"

namespace touchdown::experiments {

/// How an estimator that was fitted on the nominal scene does in a varied one.
struct Sensitivity {
  std::string factor;
  double value = 0.0;
  double nominal = 0.0;
  std::string simulator;
  std::string estimator;
  std::size_t runs = 0;    ///< that are scored
  std::size_t failed = 0;  ///< that fell or diverged
  Interval success;        ///< NaN when no run is left
};

/// One per estimator that was fitted where it is tested, at the experiment's first highlighted
/// noise setting.
std::vector<Sensitivity> sensitivity(const Variation& variation, const RunRequest& request,
                                     const Plan& plan, const PlayedRuns& runs,
                                     const SavedCounts& saved);

}  // namespace touchdown::experiments
