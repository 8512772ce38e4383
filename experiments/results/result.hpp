#pragma once

#include <string>
#include <utility>
#include <vector>

#include "experiments/fitting/fitting.hpp"
#include "experiments/evaluation/summary.hpp"
#include "experiments/rollouts/rollouts.hpp"
#include "experiments/results/scores.hpp"

namespace touchdown::experiments {

/// How a result came about, for people who ask later: nothing in it changes a result.
struct Provenance {
  std::string command;                                  ///< what was typed
  int threads = 0;                                      ///< that worked on it
  std::vector<std::pair<std::string, double>> timings;  ///< of each phase (s)
};

/// What an experiment found out. The same is in the run directory's files.
struct ExperimentResult {
  Experiment experiment;
  std::string id;
  RunDirectory directory;
  std::vector<Rollout> runs;
  FittedModels models;
  std::vector<noise::NoiseCell> cells;
  std::vector<CellSummary> summaries;       ///< of every noise cell
  std::vector<ScoreSummary> scores;         ///< of the highlighted ones
  std::vector<Difference> differences;      ///< likewise
  std::vector<std::string> studies;         ///< what the studies in it say to people, a text each
  std::vector<std::string> failed_demands;  ///< estimators whose verdict was demanded and fails
  Provenance provenance;
};

}  // namespace touchdown::experiments
