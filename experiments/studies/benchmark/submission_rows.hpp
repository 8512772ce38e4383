#pragma once

#include "experiments/studies/benchmark/tables.hpp"

namespace touchdown::experiments {

/// Writes the tables of a benchmark with its submissions, and returns their rows and standings.
/// Rows of submitted estimators that were scored in this run directory follow the others, by
/// estimator, then noise. `runs` of such a row counts runs with submitted beliefs, and failed runs.
BenchmarkResult write_benchmark(const Evaluation& evaluation, const RunDirectory& directory);

}  // namespace touchdown::experiments
