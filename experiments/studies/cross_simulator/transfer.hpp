#pragma once

#include <string>
#include <vector>

#include "core/interval.hpp"
#include "experiments/evaluation/tasks.hpp"

namespace touchdown::experiments {

/// An estimator fitted in one engine and tested in one, the same or the other, at one noise
/// setting.
struct Transfer {
  Condition condition;
  noise::NoiseCell cell;
  bool is_fitted = true;  ///< false: there is nothing to fit, every fit engine gives the same
  Interval success;
  Interval no_contact_recall;
  /// Success of the same estimator fitted in the test engine, minus this one's, on the same runs.
  Interval loss;
  /// Success minus that of always contact on the same runs.
  Interval gain;
};

/// Every estimator, fit engine and test engine of the experiment, "always contact" last.
std::vector<Condition> transfer_conditions(const Experiment& experiment);

/// Losses and gains at every highlighted noise setting, in the order of these conditions, from the
/// counts in these cells.
std::vector<Transfer> transfers(const std::vector<ConditionCounts>& counts,
                                const std::vector<noise::NoiseCell>& cells,
                                const Experiment& experiment);

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
