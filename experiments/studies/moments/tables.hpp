#pragma once

#include <array>
#include <string>
#include <vector>

#include "experiments/evaluation/tasks.hpp"
#include "experiments/run_directory/directory.hpp"
#include "experiments/studies/moments/torques.hpp"

namespace touchdown::experiments {

/// The torques of one engine's runs.
struct EngineTorques {
  std::string simulator;
  /// Knee and wheel in contact, knee and wheel in the air.
  std::array<TorqueDistribution, 4> distribution = {};
  std::array<std::vector<double>, 4> density = {};  ///< by cell
  double overlap = 0.0;                             ///< of the densities in contact and in the air
  int runs = 0;                                     ///< simulated
  int failed = 0;                                   ///< of these; not used
};

/// The torques of the experiment's own test runs, an entry per engine.
std::vector<EngineTorques> torques_by_engine(const Evaluation& evaluation);

/// Writes `moments.csv`, `torque_distributions.csv`, `torque_densities.csv` and `overlap.csv`, with
/// the real robot's numbers.
void write_tables(const std::vector<EngineTorques>& engines, const RunDirectory& directory);

/// A summary for the terminal.
std::string moments_text(const std::vector<EngineTorques>& engines, const Experiment& experiment);

}  // namespace touchdown::experiments
