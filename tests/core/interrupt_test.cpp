#include <csignal>
#include <functional>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "core/program.hpp"

namespace touchdown {
namespace {

/// How a process of its own ends that does this: its exit code, or minus the signal that killed it.
int end_of(const std::function<int()>& work) {
  const pid_t process = ::fork();
  if (process == 0) ::_exit(work());
  int status = -1;
  ::waitpid(process, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

class Interrupt : public ::testing::TestWithParam<int> {};

TEST_P(Interrupt, RequestsAStopAndKillsTheSecondTime) {
  EXPECT_EQ(end_of([] {
              const std::atomic<bool>& stop = stop_on_interrupt();
              if (stop) return 1;
              ::raise(GetParam());
              return stop ? 7 : 2;
            }),
            7);
  EXPECT_EQ(end_of([] {
              stop_on_interrupt();
              ::raise(GetParam());
              ::raise(GetParam());
              return 0;
            }),
            -GetParam());
}

INSTANTIATE_TEST_SUITE_P(Signals, Interrupt, ::testing::Values(SIGINT, SIGTERM, SIGHUP));

}  // namespace
}  // namespace touchdown
