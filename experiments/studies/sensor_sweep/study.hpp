#pragma once

#include <memory>

#include "experiments/studies/study.hpp"

namespace touchdown::experiments {

/// The section `sweep`: one disturbance of the sensors at a time.
std::unique_ptr<const Study> sensor_sweep_study();

}  // namespace touchdown::experiments
