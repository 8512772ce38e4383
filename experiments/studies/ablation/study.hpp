#pragma once

#include <memory>

#include "experiments/studies/study.hpp"

namespace touchdown::experiments {

/// The section `ablation`: the gain of one change after another.
std::unique_ptr<const Study> ablation_study();

}  // namespace touchdown::experiments
