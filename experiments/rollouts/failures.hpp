#pragma once

#include <map>
#include <string>
#include <vector>

#include "experiments/rollouts/rollouts.hpp"

namespace touchdown::experiments {

/// Describes runs that all failed by the first of them, for errors: "FILE fell after 0.675 s: pitch
/// beyond 1 rad, and 5 others". The argument holds their endings (`RunReport::ending`) by file.
std::string failures_text(const std::map<std::string, std::string>& ending_by_file);

/// One line for each run that cannot be scored, with the reason. Fits with other sensors share a
/// recording, which has one line.
std::string unused_runs_text(const std::vector<Rollout>& runs);

}  // namespace touchdown::experiments
