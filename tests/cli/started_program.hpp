#pragma once

#include <filesystem>
#include <string>
#include <sys/types.h>
#include <vector>

namespace touchdown::cli {

/// A program's output and its exit code.
struct Ended {
  int exit_code = -1;  ///< minus the signal's number if a signal ended the program
  std::string output;  ///< standard output
  std::string errors;  ///< standard error
};

/// The lines of standard error other than progress, which appears after a second.
std::vector<std::string> messages_in(const std::string& errors);

/// Of a process whose status `waitpid` returned.
int exit_code_of(int status);

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
