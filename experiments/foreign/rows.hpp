#pragma once

#include <vector>

#include "experiments/benchmark/rows.hpp"
#include "experiments/run_directory/directory.hpp"

namespace touchdown::experiments {

/// Adds to a benchmark's rows those of every estimator that is none of ours and that was scored in
/// this run directory: by estimator, noise, then as the others. `runs` of a row are those that it
/// handed beliefs in for, and those that failed.
void add_foreign_rows(const Listened& listened, const RunDirectory& directory,
                      std::vector<BenchmarkRow>& rows);

}  // namespace touchdown::experiments
