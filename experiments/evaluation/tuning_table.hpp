#pragma once

#include <filesystem>
#include <vector>

#include "experiments/evaluation/tune.hpp"
#include "experiments/figures/figure_spec.hpp"
#include "experiments/run_directory/directory.hpp"

namespace touchdown::experiments {

/// Writes `tuning.csv`: every trial with its hyperparameters, in full precision. The text is a
/// table of the scores of the defaults and of the chosen values; the figure shows every trial.
StudyResult summarize_tuning(const std::vector<Trial>& trials, const Experiment& experiment,
                             const RunDirectory& directory);

/// The values that the tuning of the experiment's own fit chose, from `tuning.csv` in a run
/// directory; empty without such a file.
TunedHyperparameters read_chosen(const std::filesystem::path& run_directory);

}  // namespace touchdown::experiments
