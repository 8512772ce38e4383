#pragma once

#include <string>
#include <vector>

#include "experiments/run_directory/directory.hpp"
#include "experiments/studies/operating_points/rows.hpp"

namespace touchdown::experiments {

/// Writes `operating_points_by_scene.csv`, and `operating_points.csv` with the means.
void write_tables(const std::vector<OperatingRow>& rows, const std::vector<OperatingMean>& means,
                  const RunDirectory& directory);

/// The terminal text: the best balanced accuracy within limits on extra switches.
std::string operating_points_text(const std::vector<OperatingMean>& means,
                                  const Experiment& experiment);

}  // namespace touchdown::experiments
