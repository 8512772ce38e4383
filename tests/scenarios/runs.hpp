#pragma once

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "scenarios/engine.hpp"
#include "simulators/registry.hpp"

namespace touchdown::scenarios {

inline Scenario scenario_called(const std::string& name) {
  Scenario scenario =
      scenario_from_yaml(YamlDocument::load(TOUCHDOWN_SOURCE_DIR "/scenarios/" + name + ".yaml"));
  scenario.robot = TOUCHDOWN_SOURCE_DIR "/models/upkie.xml";
  return scenario;
}

/// The smallest scenario: Upkie standing on the floor.
inline Scenario standing(double seconds) {
  Scenario scenario;
  scenario.name = "standing";
  scenario.robot = TOUCHDOWN_SOURCE_DIR "/models/upkie.xml";
  scenario.end.duration = seconds;
  return scenario;
}

inline bool in_contact(const models::GroundTruth& truth, std::size_t wheel) {
  return truth.wheel_normal_force[wheel] > 1.0;
}

/// Durations of the phases without contact of both wheels that last at least `shortest` (s).
inline std::vector<double> flights(const logs::Recording& recording, double shortest) {
  std::vector<double> durations;
  std::size_t steps = 0;
  for (std::size_t k = 1; k < recording.steps(); ++k) {  // no force has acted yet at step 0
    const models::GroundTruth& truth = recording.truth[k];
    if (!in_contact(truth, 0) && !in_contact(truth, 1)) {
      ++steps;
    } else {
      const double duration = static_cast<double>(steps) * recording.period();
      if (duration >= shortest) durations.push_back(duration);
      steps = 0;
    }
  }
  return durations;
}

inline std::string engine_name(const ::testing::TestParamInfo<std::string>& engine) {
  return engine.param;
}

class InEveryEngine : public ::testing::TestWithParam<std::string> {};

}  // namespace touchdown::scenarios
