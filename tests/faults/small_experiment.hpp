#pragma once

#include <string>

#include "tests/scratch_folder.hpp"

namespace touchdown::faults {

/// Writes the smallest experiment that fits, plays, keeps recordings, listens and writes tables,
/// its scenario beside it, and returns the command that runs it into `a`. One thread: what is
/// counted is counted in the same order every time.
std::string small_run(const ScratchFolder& folder);
/// The same without pictures.
std::string small_run_without_pictures(const ScratchFolder& folder);
/// With runs whose policy an estimator steers, and nobody.
std::string small_closed_loop(const ScratchFolder& folder);
/// With a film.
std::string small_run_with_film(const ScratchFolder& folder);

/// Simulates, unless that is done, and returns the command that films it in `a`.
std::string small_film(const ScratchFolder& folder);

/// Writes the configuration of the smallest training, and returns the command that trains in `a`.
std::string small_training(const ScratchFolder& folder);

/// Some faults in `make test`, each in `make faults`.
bool all_of_them();

}  // namespace touchdown::faults
