#pragma once

#include <filesystem>
#include <string>
#include <sys/types.h>
#include <vector>

#include <gtest/gtest.h>

#include "core/files.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::cli {

/// A program's output and its exit code.
struct Ended {
  int exit_code = -1;  ///< minus the signal's number if a signal ended the program
  std::string output;  ///< standard output
  std::string errors;  ///< standard error
};

/// The lines of standard error other than progress, which appears after a second.
std::vector<std::string> messages_in(const std::string& errors);

/// A command, and texts in the line with which it is refused.
struct Refusal {
  std::string arguments;
  std::vector<std::string> texts;
};

/// An empty folder in which tests run the `touchdown` of this build.
class ProgramFolder : public ScratchFolder {
 public:
  /// Runs the program to its end. `shell` is what a shell does before, as in "ulimit -f 8 &&".
  /// `arguments` may redirect streams.
  Ended run(const std::string& arguments, const std::string& shell = "") const;
  /// What the program prints. Its exit code must be 0.
  std::string output_of(const std::string& arguments) const;
  /// What the program prints on standard error. Its exit code must be 0.
  std::string messages_of(const std::string& arguments) const;
  /// The one line with which a command is refused. Nothing but progress may be printed beside it.
  std::string refusal_of(const std::string& arguments, int exit_code = 2) const;
  void expect_refusals(const std::vector<Refusal>& refusals, int exit_code = 2) const;

  std::string text(const std::string& name) const { return read_file(*this / name); }
  bool has(const std::string& name) const { return std::filesystem::exists(*this / name); }
};

/// Each test has a folder of its own.
class InFolder : public ::testing::Test {
 protected:
  const ProgramFolder folder_{};
};

/// Writes an experiment that takes about a second, and its scenarios, into the folder; returns its
/// file name.
std::string write_tiny_experiment(const ScratchFolder& folder);

/// The same with half an hour of simulation, which does not end before a test interrupts it.
std::string write_long_experiment(const ScratchFolder& folder);

/// Runs the `touchdown` of this build in `folder` while the test does something else. The process
/// does not outlive this object.
class StartedProgram {
 public:
  /// `arguments` are separated by blanks. `environment` adds NAME=VALUE entries to those of this
  /// process.
  StartedProgram(const std::string& arguments, const std::filesystem::path& folder,
                 std::vector<std::string> environment = {});
  StartedProgram(const StartedProgram&) = delete;
  StartedProgram& operator=(const StartedProgram&) = delete;
  ~StartedProgram();

  pid_t process() const { return process_; }
  void send(int signal) const;
  /// Whether the process has not ended yet.
  bool is_running();
  /// Waits until the process handles this signal, or has ended. Before, the signal kills it.
  void wait_for_handler(int signal);
  /// Sleeps for this time (s), or until the process ends.
  void let_run(double seconds);
  /// Lets the process run until a condition holds, or until it ends.
  template <typename Condition>
  void let_run_until(const Condition& condition) {
    while (is_running() && !condition()) let_run(0.002);
  }
  /// Waits for the end.
  Ended end();

 private:
  void wait(int flags);

  std::filesystem::path out_;
  std::filesystem::path err_;
  pid_t process_ = -1;
  bool ended_ = false;
  int status_ = 0;
};

}  // namespace touchdown::cli
