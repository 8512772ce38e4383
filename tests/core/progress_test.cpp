#include "core/progress.hpp"

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

}  // namespace
}  // namespace touchdown
