#pragma once

#include <string>

#include "experiments/plan/request.hpp"

namespace touchdown::experiments {

/// The README of an export: its arrays, the format of a submission, and the scoring.
std::string readme_of(const RunRequest& request);

}  // namespace touchdown::experiments
