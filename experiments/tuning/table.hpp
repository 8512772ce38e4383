#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/run_directory/directory.hpp"
#include "experiments/tuning/tune.hpp"

namespace touchdown::experiments {

/// `tuning.csv`: every trial with its constants, so exactly that they read back to the same.
void write_table(const std::vector<Trial>& trials, const RunDirectory& directory);

/// What was chosen for the experiment's own fit, as a run directory's `tuning.csv` says; nothing
/// where there is no such file.
TunedHyperparameters read_chosen(const std::filesystem::path& run_directory);

/// For people: what the defaults scored, and what was chosen.
std::string tuning_text(const std::vector<Trial>& trials, const Experiment& experiment);

}  // namespace touchdown::experiments
