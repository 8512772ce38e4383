#pragma once

#include <string>
#include <vector>

#include "experiments/config/cross_simulator.hpp"
#include "experiments/cross_simulator/transfer.hpp"

namespace touchdown::experiments {

/// What an estimator's transfers amount to.
struct Verdict {
  std::string estimator;
  bool holds = false;
  bool is_demanded = false;
  double loss = 0.0;  ///< the greatest upper end over test engines and noise settings
  double gain = 0.0;  ///< the least lower end of those that were fitted in the other engine
  std::string words;  ///< the criterion and the numbers
};

/// One per estimator of the transfers, but always contact. An estimator holds when, fitted in the
/// other engine, it loses less than allowed and beats always contact by more than asked, ends of
/// intervals included, in every engine and noise setting. A number that is not defined fails.
std::vector<Verdict> verdicts(const std::vector<Transfer>& transfers, const VerdictConfig& config,
                              double level);

/// The estimators whose verdict is demanded and fails.
std::vector<std::string> failed_demands(const std::vector<Verdict>& verdicts);

}  // namespace touchdown::experiments
