#pragma once

#include <string>
#include <vector>

#include "experiments/figures/figure_spec.hpp"

namespace touchdown::experiments {

/// What a study found, besides its files.
struct StudyResult {
  std::vector<std::string> texts = {};           ///< for the terminal
  std::vector<std::string> failed_demands = {};  ///< estimators that fail a demanded verdict
  std::vector<FigureSpec> figures = {};          ///< of its tables
};

}  // namespace touchdown::experiments
