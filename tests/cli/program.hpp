#pragma once

#include <filesystem>
#include <string>

#include "tests/scratch_folder.hpp"

namespace touchdown::cli {

/// A program's output and its exit code.
struct Ended {
  int exit_code = -1;
  std::string output;  ///< standard output
  std::string errors;  ///< standard error
};

/// Runs the `touchdown` of this build with these arguments in `folder`.
Ended touchdown_program(const std::string& arguments, const std::filesystem::path& folder);

/// Writes an experiment that takes about a second, and its scenarios, into the folder; returns its
/// file name.
std::string write_tiny_experiment(const ScratchFolder& folder);

/// The same with half an hour of simulation, which does not end before a test interrupts it.
std::string write_long_experiment(const ScratchFolder& folder);

}  // namespace touchdown::cli
