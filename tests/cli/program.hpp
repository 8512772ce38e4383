#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/files.hpp"
#include "tests/cli/started_program.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::cli {

/// A command, and texts in the line with which it is refused.
struct Refusal {
  std::string arguments;
  std::vector<std::string> texts;
};

/// An empty folder in which tests run the `touchdown` of this build.
class ProgramFolder : public ScratchFolder {
 public:
  /// With `executes`, `run` executes the program, for tests that stop and continue what it saves.
  explicit ProgramFolder(bool executes = false) : executes_(executes) {}

  /// Calls the program's function in a process of its own, which saves the time to load libraries.
  /// Its saved state is that of another build than the program's. Arguments that need a shell,
  /// because they redirect streams, are executed.
  Ended run(const std::string& arguments) const;
  /// Executes the program. `shell` is what a shell does before, as in "ulimit -f 8 &&".
  Ended execute(const std::string& arguments, const std::string& shell = "") const;
  /// What the program prints. Its exit code must be 0.
  std::string output_of(const std::string& arguments) const;
  /// What the program prints on standard error. Its exit code must be 0.
  std::string messages_of(const std::string& arguments) const;
  /// The one line with which a command is refused. Nothing but progress may be printed beside it.
  std::string refusal_of(const std::string& arguments, int exit_code = 2) const;
  void expect_refusals(const std::vector<Refusal>& refusals, int exit_code = 2) const;

  std::string text(const std::string& name) const { return read_file(*this / name); }
  /// Fills the folder with what `make` writes into an empty one, which happens once in each process
  /// for all tests that ask for the same `name`.
  void fill(const std::string& name, const std::function<void(const ProgramFolder&)>& make) const;
  bool has(const std::string& name) const { return std::filesystem::exists(*this / name); }

 private:
  bool executes_;
};

/// Each test has a folder of its own.
class InFolder : public ::testing::Test {
 protected:
  explicit InFolder(bool executes = false) : folder_(executes) {}

  const ProgramFolder folder_;
};

/// Writes an experiment that takes about a second, and its scenarios, into the folder; returns its
/// file name.
std::string write_tiny_experiment(const ScratchFolder& folder);

/// Fills the folder with the tiny experiment and its finished run `a`, which `flags` are for.
void write_finished_run(const ProgramFolder& folder, const std::string& flags = "--no-pictures");

/// The same with half an hour of simulation, which does not end before a test interrupts it.
std::string write_long_experiment(const ScratchFolder& folder);

}  // namespace touchdown::cli
