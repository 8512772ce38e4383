#pragma once

#include <string>

#include "experiments/plan/request.hpp"

namespace touchdown::experiments {

/// What stands beside an export: what its arrays are, what to hand in, how that is scored.
std::string readme_of(const RunRequest& request);

}  // namespace touchdown::experiments
