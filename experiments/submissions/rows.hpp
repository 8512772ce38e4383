#pragma once

#include "experiments/studies/benchmark/tables.hpp"

namespace touchdown::experiments {

/// A benchmark's rows, then those of every estimator that is none of ours and that was scored in
/// this run directory: by estimator, noise, then as the others. `runs` of a row are those that it
/// handed beliefs in for, and those that failed. With their standings; all of it is written into
/// the directory's tables.
BenchmarkResult write_benchmark(const Evaluation& evaluation, const RunDirectory& directory);

}  // namespace touchdown::experiments
