#include "core/progress.hpp"

#include <csignal>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace touchdown {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(Progress, LeavesOnePlainLineWhereNobodyWatches) {
  testing::internal::CaptureStderr();
  {
    Progress progress("listening", "parts", 5);
    progress.skip(2);
    for (int i = 0; i < 3; ++i) progress.advance();
  }
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_THAT(said, AllOf(StartsWith("listening: 5/5 parts"), HasSubstr("2 of them were there")));
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1);
  EXPECT_EQ(said.find('\x1b'), std::string::npos);
}

TEST(Progress, SaysNothingAboutNothing) {
  testing::internal::CaptureStderr();
  { const Progress progress("listening", "parts", 5); }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

/// What becomes of a process that tells something on a standard error of the test's choice.
template <typename Spoil>
int status_of_teller(const Spoil& spoil) {
  const pid_t process = ::fork();
  if (process == 0) {
    ::signal(SIGPIPE, SIG_DFL);
    spoil();
    {
      Progress progress("listening", "parts", 2);
      progress.advance();
    }
    tell(std::string(1 << 20, 'x'));
    ::_exit(7);
  }
  int status = -1;
  ::waitpid(process, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

TEST(Tell, NeverStopsAnybodyWhateverBecameOfStandardError) {
  EXPECT_EQ(status_of_teller([] { ::dup2(::open("/dev/null", O_WRONLY), STDERR_FILENO); }), 7);
  EXPECT_EQ(status_of_teller([] { ::dup2(::open("/dev/full", O_WRONLY), STDERR_FILENO); }), 7);
  EXPECT_EQ(status_of_teller([] { ::dup2(::open("/dev/null", O_RDONLY), STDERR_FILENO); }), 7);
  EXPECT_EQ(status_of_teller([] { ::close(STDERR_FILENO); }), 7);
  EXPECT_EQ(status_of_teller([] {  // a pipe that nobody reads any more
              int ends[2];
              if (::pipe(ends) != 0) return;
              ::dup2(ends[1], STDERR_FILENO);
              ::close(ends[0]);
              ::close(ends[1]);
            }),
            7);
}

TEST(Tell, LeavesABrokenPipeElsewhereAsItIs) {
  EXPECT_EQ(status_of_teller([] {
              tell("");
              int ends[2];
              if (::pipe(ends) != 0) return;
              ::close(ends[0]);
              (void)!::write(ends[1], "x", 1);
            }),
            -SIGPIPE);
}

}  // namespace
}  // namespace touchdown
