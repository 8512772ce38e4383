#pragma once

#include <sys/wait.h>
#include <unistd.h>

namespace touchdown {

/// How a process of its own ends that does this: its exit code, or minus the signal that ended it.
template <typename Work>
int end_of(const Work& work) {
  const pid_t process = ::fork();
  if (process == 0) ::_exit(work());
  int status = -1;
  ::waitpid(process, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

}  // namespace touchdown
