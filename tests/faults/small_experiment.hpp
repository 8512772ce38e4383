#pragma once

#include <string>

#include "tests/scratch_folder.hpp"

namespace touchdown::faults {

/// Writes the smallest experiment that fits, simulates, keeps recordings, evaluates and writes
/// tables, with its scenario. Returns the command that runs it into `a`, with one thread, so that
/// calls are counted in the same order every time.
std::string small_run(const ScratchFolder& folder);
/// The same without pictures.
std::string small_run_without_pictures(const ScratchFolder& folder);
/// With closed-loop runs: contact from an estimator, from the truth, or always reported.
std::string small_closed_loop(const ScratchFolder& folder);
/// With a film.
std::string small_run_with_film(const ScratchFolder& folder);

/// Simulates a run, unless it exists, and returns the command that films it into `a`.
std::string small_film(const ScratchFolder& folder);

/// Writes the configuration of the smallest training, and returns the command that trains into `a`.
std::string small_training(const ScratchFolder& folder);

/// Whether all faults are tested, as in `make faults`, or some, as in `make test`.
bool all_of_them();

}  // namespace touchdown::faults
