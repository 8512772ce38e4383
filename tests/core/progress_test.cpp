#include "core/progress.hpp"

#include <csignal>
#include <fcntl.h>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/core/child_process.hpp"

namespace touchdown {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(Progress, PrintsOnePlainLineWithoutATerminal) {
  testing::internal::CaptureStderr();
  {
    Progress progress("evaluation", "parts", 5);
    progress.skip(2);
    for (int i = 0; i < 3; ++i) progress.advance();
  }
  const std::string text = testing::internal::GetCapturedStderr();
  EXPECT_THAT(text, AllOf(StartsWith("evaluation: 5/5 parts"), HasSubstr("2 of them done before")));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1);
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
}

TEST(Progress, PrintsNothingIfNothingWasDone) {
  testing::internal::CaptureStderr();
  { const Progress progress("evaluation", "parts", 5); }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

/// Exit status of a process that prints messages after `spoil` has changed its standard error. A
/// signal that ended it is negative.
template <typename Spoil>
int status_of_printer(const Spoil& spoil) {
  return end_of([&] {
    ::signal(SIGPIPE, SIG_DFL);
    spoil();
    {
      Progress progress("evaluation", "parts", 2);
      progress.advance();
    }
    print_message(std::string(1 << 20, 'x'));
    return 7;
  });
}

TEST(PrintMessage, NeverEndsTheProcessWhateverStandardErrorIs) {
  EXPECT_EQ(status_of_printer([] { ::dup2(::open("/dev/null", O_WRONLY), STDERR_FILENO); }), 7);
  EXPECT_EQ(status_of_printer([] { ::dup2(::open("/dev/full", O_WRONLY), STDERR_FILENO); }), 7);
  EXPECT_EQ(status_of_printer([] { ::dup2(::open("/dev/null", O_RDONLY), STDERR_FILENO); }), 7);
  EXPECT_EQ(status_of_printer([] { ::close(STDERR_FILENO); }), 7);
  EXPECT_EQ(status_of_printer([] {  // a pipe without a reader
              int ends[2];
              if (::pipe(ends) != 0) return;
              ::dup2(ends[1], STDERR_FILENO);
              ::close(ends[0]);
              ::close(ends[1]);
            }),
            7);
}

TEST(PrintMessage, LeavesOtherBrokenPipesAlone) {
  EXPECT_EQ(status_of_printer([] {
              print_message("");
              int ends[2];
              if (::pipe(ends) != 0) return;
              ::close(ends[0]);
              (void)!::write(ends[1], "x", 1);
            }),
            -SIGPIPE);
}

}  // namespace
}  // namespace touchdown
