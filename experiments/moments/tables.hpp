#pragma once

#include <string>
#include <vector>

#include "experiments/listening/tasks.hpp"
#include "experiments/moments/torques.hpp"
#include "experiments/run_directory/directory.hpp"

namespace touchdown::experiments {

/// What the experiment's own test runs heard, an entry per engine.
std::vector<EngineTorques> torques_by_engine(const Listened& listened);

/// `moments.csv`, `torque_distributions.csv` and `overlap.csv`, beside the real robot's numbers.
void write_tables(const std::vector<EngineTorques>& engines, const RunDirectory& directory);

/// The same in short, for people.
std::string moments_text(const std::vector<EngineTorques>& engines, const Experiment& experiment);

}  // namespace touchdown::experiments
