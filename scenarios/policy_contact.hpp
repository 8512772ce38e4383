#pragma once

#include "policies/wheel_contact.hpp"
#include "scenarios/scenario.hpp"
#include "simulators/simulator.hpp"

namespace touchdown::scenarios {

/// The contact source of the scenario's policy: `contact_source` if it is given, else the one named
/// by `policy.contact`. Its reports are delayed by `policy.delay` (s). `truth` is an oracle: it
/// reads `simulator`, which must outlive the result.
policies::WheelContact policy_contact(const Scenario& scenario,
                                      const simulators::Simulator& simulator,
                                      policies::WheelContact contact_source = {});

}  // namespace touchdown::scenarios
