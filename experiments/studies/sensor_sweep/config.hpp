#pragma once

#include <string>
#include <vector>

#include "experiments/config/study_sections.hpp"

namespace touchdown::experiments {

/// A disturbance of the sensors that is varied, with all others unchanged.
struct SensorFactor {
  std::string key;             ///< a key of `noise::with_value`
  std::vector<double> values;  ///< in its own unit
};

/// The section `sweep`: disturbances that are varied, one at a time.
struct SensorSweepConfig {
  std::vector<SensorFactor> factors;
};

/// The section and its keys. An experiment without factors has no section.
StudySection sensor_sweep_section();

}  // namespace touchdown::experiments
