#pragma once

#include <string>
#include <vector>

#include "experiments/run_directory/directory.hpp"
#include "experiments/studies/benchmark/standings.hpp"

namespace touchdown::experiments {

/// The result of a benchmark.
struct BenchmarkResult {
  std::vector<BenchmarkRow> rows;
  std::vector<Standings> standings;
  std::vector<Standings> unseen;  ///< over the unseen scenes
};

/// Adds the standings.
BenchmarkResult with_standings(std::vector<BenchmarkRow> rows,
                               const scoring::BootstrapConfig& intervals);

/// Writes `benchmark.csv`, `benchmark_standings.csv`, `benchmark_unseen.csv`,
/// `benchmark_differences.csv`, all four as `benchmark.json`, and `benchmark_unseen.md`.
void write_tables(const BenchmarkResult& result, const Experiment& experiment,
                  const RunDirectory& directory);

/// The terminal text: standings for every robot with its sensors, and scores by scene for the
/// experiment's own.
std::string benchmark_text(const BenchmarkResult& result, const Experiment& experiment);

}  // namespace touchdown::experiments
