#pragma once

#include <memory>

#include "experiments/studies/study.hpp"

namespace touchdown::experiments {

/// The section `closed_loop`: runs with contact feedback to the policy.
std::unique_ptr<const Study> closed_loop_study();

}  // namespace touchdown::experiments
