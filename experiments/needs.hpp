#pragma once

#include "experiments/plan/plan.hpp"

namespace touchdown::experiments {

/// How much an experiment asks for. Known before it is planned: its plan alone may be too large.
struct Needs {
  double runs = 0.0;
  double parts = 0.0;    ///< of the listening
  double seconds = 0.0;  ///< that all runs surely last together, as far as none falls
  double steps = 0.0;    ///< of control in them
};
Needs needs_of(const RunRequest& request);

/// Memory and swap of this machine (bytes).
double memory_of_machine();

/// Errors: `Error` that names the settings when the plan and this share of the runs' signals do not
/// fit into so much memory.
void require_memory(const RunRequest& request, double share_of_runs,
                    double memory = memory_of_machine());

/// The most that a run may write in all (bytes).
struct DiskNeeds {
  double recordings = 0.0;
  double parts = 0.0;
  double results = 50e6;  ///< pictures and tables

  double all() const { return recordings + parts + results; }
};

/// What the parts of a plan take as files.
double bytes_of_parts(const Plan& plan);

}  // namespace touchdown::experiments
