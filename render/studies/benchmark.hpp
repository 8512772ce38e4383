#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/table.hpp"
#include "render/report/report.hpp"

namespace touchdown::render {

/// A benchmark's results: tables of its run directory.
struct BenchmarkTables {
  Table scenes;     ///< `benchmark.csv`: in-domain scores alone
  Table standings;  ///< `benchmark_standings.csv`
  std::vector<experiments::EstimatorEntry> external = {};  ///< those written in Python
};

/// Empty where the run directory has no such tables. Errors: `InputError` for unreadable ones.
BenchmarkTables benchmark_tables(const std::filesystem::path& run_directory);

/// The robot and the sensors of a row, "upkie, harsh sensors", and its noise, "1 N·m, 5 m/s²".
std::string setting_of(const TableRow& row);
std::string noise_of(const TableRow& row);
inline std::string estimator_of(const TableRow& row) { return row.text("estimator"); }
inline double mean_of(const TableRow& standing) {
  return standing.number("mean_balanced_accuracy");
}

/// Writes `benchmark.html` into the run directory of an experiment with a benchmark, from its
/// tables and figures: the ranking, robots × sensors, every scene, a card for each estimator.
/// Returns the page.
std::filesystem::path write_benchmark_page(const ReportSubject& subject);

/// The segment with the most wrong decisions of an estimator.
struct WorstSegment {
  std::size_t run = 0;     ///< index of the run
  std::size_t begin = 0;   ///< first step
  std::int64_t wrong = 0;  ///< wrong decisions about wheels in the segment
};

/// The first of the worst segments of `length` steps. `wrong` contains, for each run and step, the
/// number of wheels with a wrong decision. A shorter run counts as one segment.
WorstSegment worst_segment(const std::vector<std::vector<int>>& wrong, std::size_t length);

}  // namespace touchdown::render
