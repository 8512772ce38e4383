#pragma once

#include "core/machine.hpp"
#include "experiments/plan/plan.hpp"

namespace touchdown::experiments {

/// The size of an experiment with its studies.
Needs needs_of(const RunRequest& request);

/// The test runs that keep signals in memory: the most that a study or a picture needs; all for an
/// experiment without studies.
KeptSignals kept_signals(const Experiment& experiment);

/// Memory that the plan and this share of the runs' signals need at least (bytes).
double least_memory(const RunRequest& request, double share_of_runs);

/// Checks that the plan and this share of the runs' signals fit into `memory` (bytes). Errors:
/// `Error` that names the settings to lower.
void require_memory(const RunRequest& request, double share_of_runs,
                    double memory = machine_share().memory);

/// An upper bound of what a run writes (bytes).
struct DiskNeeds {
  double recordings = 0.0;
  double parts = 0.0;
  double samples = 0.0;   ///< tables/samples.csv
  double results = 50e6;  ///< pictures and other tables

  double all() const { return recordings + parts + samples + results; }
};

/// What a plan may still write into this run directory; without one, what it writes in all.
DiskNeeds disk_needs(const Plan& plan, const Experiment& experiment,
                     const RunDirectory* directory = nullptr);

}  // namespace touchdown::experiments
