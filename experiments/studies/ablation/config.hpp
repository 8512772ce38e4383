#pragma once

#include <string>
#include <vector>

#include "experiments/config/study_sections.hpp"

namespace touchdown::experiments {

/// The section `ablation`: each estimator of a row is compared with the one before it. The row is a
/// part of the experiment's estimators, which may then name those of `ablation_estimators`.
struct AblationConfig {
  std::string from;  ///< the first of the row
  std::string to;    ///< the last of the row
};

/// The section, its keys and its estimators.
StudySection ablation_section();

/// The estimators of the row. Errors: none for a configuration that was read.
std::vector<std::string> steps_of(const AblationConfig& config,
                                  const std::vector<std::string>& estimators);

}  // namespace touchdown::experiments
