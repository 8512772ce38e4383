#pragma once

#include <memory>

#include "experiments/studies/study.hpp"

namespace touchdown::experiments {

/// The key `moments`: torques beside the real robot's.
std::unique_ptr<const Study> moments_study();

}  // namespace touchdown::experiments
