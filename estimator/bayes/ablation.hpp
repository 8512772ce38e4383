#pragma once

#include <span>

#include "estimator/bayes/config.hpp"

namespace touchdown {

/// One step of the ablation between `paper` and `robust`.
struct AblationStep {
  const char* name;
  const char* change;  ///< one line: the difference from the previous step
  BayesFilterConfig config;
};

/// The ablation from `paper` to `robust`. The first step changes `paper`; each further step adds
/// one change. The last step lacks one change from `robust`: rows that sum to one. Changes of the
/// torques come before those of the transitions, so that all steps from the last change of the
/// torques on share a fit with `robust`.
std::span<const AblationStep> steps_from_paper_to_robust();

}  // namespace touchdown
