#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/run_directory/directory.hpp"
#include "experiments/tuning/tune.hpp"

namespace touchdown::experiments {

/// Writes `tuning.csv`: every trial with its hyperparameters, in full precision.
void write_table(const std::vector<Trial>& trials, const RunDirectory& directory);

/// The values that the tuning of the experiment's own fit chose, from `tuning.csv` in a run
/// directory; empty without such a file.
TunedHyperparameters read_chosen(const std::filesystem::path& run_directory);

/// A table as text: the scores of the defaults and of the chosen values.
std::string tuning_text(const std::vector<Trial>& trials, const Experiment& experiment);

}  // namespace touchdown::experiments
