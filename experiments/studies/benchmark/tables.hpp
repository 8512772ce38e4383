#pragma once

#include <string>
#include <vector>

#include "experiments/studies/benchmark/standings.hpp"
#include "experiments/run_directory/directory.hpp"

namespace touchdown::experiments {

/// What a benchmark found out.
struct BenchmarkResult {
  std::vector<BenchmarkRow> rows;
  std::vector<Standings> standings;
};

/// `level`, here and below, is that of the intervals.
BenchmarkResult with_standings(std::vector<BenchmarkRow> rows, double level);

/// `benchmark.csv`, `benchmark_standings.csv`, `benchmark_differences.csv`, and all three as
/// `benchmark.json`.
void write_tables(const BenchmarkResult& result, double level, const RunDirectory& directory);

/// For people: who stands where with every robot and its sensors, and scene by scene with the
/// experiment's own.
std::string benchmark_text(const BenchmarkResult& result, const Experiment& experiment);

}  // namespace touchdown::experiments
