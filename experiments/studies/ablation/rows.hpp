#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/interval.hpp"
#include "experiments/evaluation/tasks.hpp"

namespace touchdown::experiments {

/// One estimator of the row in one noise setting: means over scenes and engines with equal weights.
struct AblationRow {
  noise::NoiseCell noise;
  std::string estimator;
  Interval balanced_accuracy;
  std::string before;            ///< the estimator before it; empty for the first one
  std::optional<Interval> gain;  ///< over that one, in the same runs and resamples
  int runs = 0;                  ///< scored
};

/// Rows by noise, then step. Refits of a benchmark widen the intervals, as in its standings.
std::vector<AblationRow> ablation_rows(const Evaluation& evaluation);

}  // namespace touchdown::experiments
