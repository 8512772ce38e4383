#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/table.hpp"
#include "experiments/evaluation/summary.hpp"
#include "experiments/plan/rollouts.hpp"
#include "experiments/results/scores.hpp"

namespace touchdown::experiments {

struct ExperimentResult;

/// One run of an experiment.
struct RunSummary {
  RunRole role = RunRole::test;
  std::string simulator;
  std::int64_t run = 0;   ///< its index, unique within one engine
  std::string recording;  ///< its file's name
  logs::Outcome outcome = logs::Outcome::finished;
  int flights = 0;        ///< of both wheels at once
  int wheel_flights = 0;  ///< of one wheel alone
};

/// An experiment's result for other programs: `tables/summary.json` of its run directory. Numbers
/// are rounded as in the CSV tables; metrics are in the order of `metrics()`.
struct Summary {
  std::vector<RunSummary> runs;
  std::vector<CellSummary> cells;    ///< without their encoder noise
  std::vector<ScoreSummary> scores;  ///< without their totals and reliability curves
  std::vector<Difference> differences;
};

Summary summary_of(const ExperimentResult& result);

void write_summary(const Summary& summary, const std::filesystem::path& run_directory);

/// Errors: `InputError` when the file is broken or missing; older programs did not write it.
Summary read_summary(const std::filesystem::path& run_directory);

/// A list of its rows, each an object by column; undefined numbers are null.
nlohmann::ordered_json json_of(const Table& table);

/// What is wrong with a JSON file, without the library's own number of the error.
std::string reason_of(const nlohmann::json::exception& error);

}  // namespace touchdown::experiments
