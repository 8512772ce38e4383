#pragma once

#include <string>

#include "experiments/listening/tasks.hpp"

namespace touchdown::experiments {

/// What the phase filter's study found out, as Markdown; `counts` are those of the experiment's own
/// test runs.
std::string phase_study_text(const RunRequest& request, const Plan& plan, const PlayedRuns& runs,
                             const CollectedCounts& counts, const SavedCounts& saved);

}  // namespace touchdown::experiments
