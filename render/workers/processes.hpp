#pragma once

#include <csignal>
#include <cstddef>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace touchdown::render {

/// Forked processes that are gone when this is gone.
class Workers {
 public:
  Workers() = default;
  ~Workers() {
    for (const pid_t pid : pids_) {
      if (pid > 0) ::kill(pid, SIGKILL);
    }
    for (const pid_t pid : pids_) {
      if (pid > 0) ::waitpid(pid, nullptr, 0);
    }
  }
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  /// False when the system has no process left to give.
  template <typename Work>
  bool start(const Work& work_in_child) {
    const pid_t parent = ::getpid();
    const pid_t pid = ::fork();
    if (pid < 0) return false;
    if (pid == 0) {
      ::prctl(PR_SET_PDEATHSIG, SIGKILL);
      if (::getppid() != parent) ::_exit(1);
      work_in_child();
    }
    pids_.push_back(pid);
    return true;
  }

  /// Whether a worker is gone; remembers it.
  bool gone(std::size_t worker) {
    if (pids_[worker] < 0) return true;
    if (::waitpid(pids_[worker], nullptr, WNOHANG) == 0) return false;
    pids_[worker] = -1;
    return true;
  }

  std::size_t count() const { return pids_.size(); }

 private:
  std::vector<pid_t> pids_;
};

}  // namespace touchdown::render
