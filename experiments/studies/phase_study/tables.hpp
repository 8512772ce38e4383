#pragma once

#include <string>

#include "experiments/evaluation/tasks.hpp"

namespace touchdown::experiments {

/// The result of the phase filter's study, as Markdown.
std::string phase_study_text(const Evaluation& evaluation);

}  // namespace touchdown::experiments
