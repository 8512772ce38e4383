#pragma once

#include <string>

#include "experiments/evaluation/tasks.hpp"

namespace touchdown::experiments {

/// What the phase filter's study found out, as Markdown.
std::string phase_study_text(const Evaluation& evaluation);

}  // namespace touchdown::experiments
