#pragma once

#include <memory>

#include "experiments/studies/study.hpp"

namespace touchdown::experiments {

/// The section `cross_simulator`: agreement of the engines, transfer and sensitivity.
std::unique_ptr<const Study> cross_simulator_study();

}  // namespace touchdown::experiments
