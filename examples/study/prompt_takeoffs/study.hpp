#pragma once

#include <memory>

#include "experiments/studies/study.hpp"

namespace touchdown::experiments {

/// The section `prompt_takeoffs`: the share of flights that are detected soon after takeoff.
std::unique_ptr<const Study> prompt_takeoffs_study();

}  // namespace touchdown::experiments
