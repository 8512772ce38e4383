#pragma once

#include <memory>

#include "experiments/studies/study.hpp"

namespace touchdown::experiments {

/// The section `benchmark`: estimators scene by scene, on several robots and sensors.
std::unique_ptr<const Study> benchmark_study();

}  // namespace touchdown::experiments
