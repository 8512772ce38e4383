#pragma once

#include <string>
#include <utility>
#include <vector>

#include "experiments/experiment.hpp"
#include "experiments/run_plan.hpp"

namespace touchdown {

/// How a result came about, for people who ask later: nothing in it changes a result.
struct Provenance {
  std::string command;                                  ///< what was typed
  int threads = 0;                                      ///< that worked on it
  std::vector<std::pair<std::string, double>> timings;  ///< of each phase (s)
};

/// `manifest.json`: versions, seeds, host, timings, runs that failed.
std::string manifest(const Experiment& experiment, const std::string& id,
                     const std::vector<PlayedRun>& runs, const Provenance& provenance);

/// A name for the program that is running: equal programs have equal names.
std::string build_fingerprint();

}  // namespace touchdown
