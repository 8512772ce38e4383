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
  bool is_fitted = true;  ///< false: nothing to fit, the engine of the fit is irrelevant
  Interval success;       ///< accuracy
  Interval no_contact_recall;
  /// Accuracy of the same estimator fitted in the test engine, minus this one's, on the same runs.
  Interval loss;
  /// Accuracy minus that of always contact on the same runs.
  Interval gain;
};

/// Every estimator, fit engine and test engine of the experiment, "always contact" last.
std::vector<Condition> transfer_conditions(const Experiment& experiment);

/// Losses and gains at every highlighted noise setting, in the order of `transfer_conditions`, from
/// the counts in these cells.
std::vector<Transfer> transfers(const std::vector<ConditionCounts>& counts,
                                const std::vector<noise::NoiseCell>& cells,
                                const Experiment& experiment);

/// The verdict on an estimator's transfers.
struct Verdict {
  std::string estimator;
  bool holds = false;
  bool is_demanded = false;
  double loss = 0.0;  ///< greatest upper end over test engines and noise settings
  double gain = 0.0;  ///< least lower end, fitted in the other engine
  std::string words;  ///< the criterion and the numbers
};

/// One verdict per estimator, except always contact. An estimator passes if, fitted in the other
/// engine, its loss is below the limit and its gain over always contact is above the limit. This
/// must hold for the ends of the intervals in every engine and noise setting. Undefined numbers
/// fail.
std::vector<Verdict> verdicts(const std::vector<Transfer>& transfers, const Experiment& experiment);

/// The estimators that fail a demanded verdict.
std::vector<std::string> failed_demands(const std::vector<Verdict>& verdicts);

}  // namespace touchdown::experiments
