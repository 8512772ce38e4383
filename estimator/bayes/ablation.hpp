#pragma once

#include <span>

#include "estimator/bayes/config.hpp"

namespace touchdown {

/// A configuration between `paper` and `robust`.
struct AblationStep {
  const char* name;    ///< of the newest change
  const char* change;  ///< one line: what differs from the rung before
  BayesFilterConfig config;
};

/// From `paper` to `robust`, one change at a time: each rung is the one before it with one change,
/// the first changes `paper`, and the one change that the last still lacks (rows that sum to one)
/// makes `robust`. First what torques are heard as, then the transitions, so that all from the last
/// change of torques on share a fit with `robust`.
std::span<const AblationStep> steps_from_paper_to_robust();

}  // namespace touchdown
