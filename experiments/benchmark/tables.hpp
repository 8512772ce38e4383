#pragma once

#include <string>
#include <vector>

#include "experiments/benchmark/standings.hpp"
#include "experiments/run_directory/directory.hpp"

namespace touchdown::experiments {

/// What a benchmark found out.
struct BenchmarkResult {
  std::vector<BenchmarkRow> rows;
  std::vector<Standings> standings;
};

/// `benchmark.csv`, `benchmark_standings.csv`, `benchmark_differences.csv`, all three as
/// `benchmark.json`, and where measurement models were fitted, `density_overlap.csv`.
void write_tables(const BenchmarkResult& result, const FittedModels& models,
                  const Listened& listened, const RunDirectory& directory);

/// For people: who stands where with every robot and its sensors, and scene by scene with the
/// experiment's own.
std::string benchmark_text(const BenchmarkResult& result, const Experiment& experiment);

}  // namespace touchdown::experiments
