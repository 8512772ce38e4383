#pragma once

#include <string>
#include <utility>
#include <vector>

#include "experiments/figures/figure_spec.hpp"
#include "experiments/fitting/fitting.hpp"
#include "experiments/plan/request.hpp"
#include "experiments/plan/rollouts.hpp"
#include "experiments/results/scores.hpp"

namespace touchdown::experiments {

/// How a result was made, for the record: nothing in it changes a result.
struct Provenance {
  std::string command;                                  ///< as typed
  int threads = 0;                                      ///< number of worker threads
  std::vector<std::pair<std::string, double>> timings;  ///< of each phase (s)
};

/// The result of an experiment. The run directory's files hold the same.
struct ExperimentResult {
  Experiment experiment;
  std::string id;
  std::vector<RequestInput> inputs;
  RunDirectory directory;
  std::vector<FinishedRun> runs = {};
  FittedModels models = {};
  std::vector<noise::NoiseCell> cells = {};
  ScoreTables tables = {};
  std::vector<std::string> studies = {};         ///< terminal text of each study
  std::vector<FigureSpec> figures = {};          ///< of the studies' tables
  std::vector<std::string> failed_demands = {};  ///< estimators that fail a demanded verdict
  Provenance provenance = {};
};

}  // namespace touchdown::experiments
