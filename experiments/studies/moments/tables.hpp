#pragma once

#include <array>
#include <string>
#include <vector>

#include "experiments/evaluation/tasks.hpp"
#include "experiments/studies/moments/torques.hpp"
#include "experiments/run_directory/directory.hpp"

namespace touchdown::experiments {

/// What one engine's robot felt.
struct EngineTorques {
  std::string simulator;
  /// Knee and wheel in contact, knee and wheel in the air.
  std::array<TorqueDistribution, 4> distribution = {};
  std::array<std::vector<double>, 4> density = {};  ///< by cell
  double overlap = 0.0;                             ///< of contact and air
  int runs = 0;                                     ///< that were played
  int failed = 0;                                   ///< of these; nothing is heard of them
};

/// What the experiment's own test runs heard, an entry per engine.
std::vector<EngineTorques> torques_by_engine(const Evaluation& evaluation);

/// `moments.csv`, `torque_distributions.csv`, `torque_densities.csv` and `overlap.csv`, beside the
/// real robot's numbers.
void write_tables(const std::vector<EngineTorques>& engines, const RunDirectory& directory);

/// The same in short, for people.
std::string moments_text(const std::vector<EngineTorques>& engines, const Experiment& experiment);

}  // namespace touchdown::experiments
