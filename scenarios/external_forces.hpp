#pragma once

#include <span>
#include <vector>

#include "scenarios/scenario.hpp"
#include "simulators/simulator.hpp"

namespace touchdown::scenarios {

/// What pulls at the robot from outside while a scenario is played: its tether, its
/// guides and its timed forces. Keeps a reference to the scenario.
class ExternalForces {
 public:
  explicit ExternalForces(const Scenario& scenario) : scenario_(scenario) {}

  /// The forces of the coming control step; valid until the next call.
  std::span<const simulators::ExternalWrench> on(const simulators::Simulator& simulator);

 private:
  const Scenario& scenario_;
  std::vector<simulators::ExternalWrench> wrenches_;
};

}  // namespace touchdown::scenarios
