#pragma once

#include <filesystem>
#include <string>
#include <sys/types.h>
#include <vector>

#include "program.hpp"

namespace touchdown::cli {

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

  void send(int signal) const;
  /// Whether the process has not ended yet.
  bool is_running();
  /// Waits until the process handles this signal, or has ended. Before, the signal kills it.
  void wait_for_handler(int signal);
  /// Sleeps for this time (s), or until the process ends.
  void let_run(double seconds);
  /// Waits for the end. The exit code is minus the signal's number if a signal killed the process.
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
