#pragma once

#include <filesystem>
#include <string>
#include <sys/types.h>
#include <vector>

#include "program.hpp"

namespace touchdown::cli {

/// The `touchdown` that was built, at work in `folder` while the test does something else. It does
/// not outlive this object.
class StartedProgram {
 public:
  /// `arguments` are separated by blanks; `environment` is what it gets besides this process's,
  /// NAME=VALUE each.
  StartedProgram(const std::string& arguments, const std::filesystem::path& folder,
                 std::vector<std::string> environment = {});
  StartedProgram(const StartedProgram&) = delete;
  StartedProgram& operator=(const StartedProgram&) = delete;
  ~StartedProgram();

  void send(int signal) const;
  /// Whether it has not ended yet.
  bool is_running();
  /// Sleeps so long, or until it ends.
  void let_run(double seconds);
  /// Its end: the exit code, or minus the number of the signal that killed it.
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
