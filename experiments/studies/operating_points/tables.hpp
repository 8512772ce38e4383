#pragma once

#include <string>
#include <vector>

#include "experiments/studies/operating_points/rows.hpp"
#include "experiments/run_directory/directory.hpp"

namespace touchdown::experiments {

/// `operating_points_by_scene.csv`, and `operating_points.csv` of their means.
void write_tables(const std::vector<OperatingRow>& rows, const std::vector<OperatingMean>& means,
                  const RunDirectory& directory);

/// For people: the best balanced accuracy with at most so many extra switches.
std::string operating_points_text(const std::vector<OperatingMean>& means,
                                  const Experiment& experiment);

}  // namespace touchdown::experiments
