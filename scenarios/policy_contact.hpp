#pragma once

#include "policies/wheel_contact.hpp"
#include "scenarios/scenario.hpp"
#include "simulators/simulator.hpp"

namespace touchdown::scenarios {

/// Who tells the scenario's policy about contact, `policy.late` seconds late: `told` if it is
/// given, else by the name under `policy.contact`. `truth` is an oracle: it looks at `simulator`,
/// which must outlive what is returned.
policies::WheelContact policy_contact(const Scenario& scenario,
                                      const simulators::Simulator& simulator,
                                      policies::WheelContact told = {});

}  // namespace touchdown::scenarios
