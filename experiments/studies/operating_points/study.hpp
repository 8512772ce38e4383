#pragma once

#include <memory>

#include "experiments/studies/study.hpp"

namespace touchdown::experiments {

/// The section `operating_points`: decisions at other thresholds of P(contact).
std::unique_ptr<const Study> operating_points_study();

}  // namespace touchdown::experiments
