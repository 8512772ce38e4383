#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "experiments/run_directory/directory.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

TEST(FreeSpace, TooLittleForARunIsAnErrorWithAdvice) {
  const ScratchFolder folder;
  EXPECT_NO_THROW(require_free_space(folder.path(), 1));
  EXPECT_THAT(
      [&] { require_free_space(folder.path(), std::uintmax_t{1} << 62); },
      ThrowsMessage<Error>(AllOf(HasSubstr(folder.path().string()), HasSubstr("GB are free"),
                                 HasSubstr("recordings=pictured"))));
}

TEST(FreeSpace, TheErrorNamesThePurposeOfTheSpace) {
  const ScratchFolder folder;
  EXPECT_THAT([&] { require_free_space(folder.path(), std::uintmax_t{1} << 62, "so many parts"); },
              ThrowsMessage<Error>(HasSubstr("may need 4611686018.4 GB (so many parts), and ")));
}

TEST(FreeSpace, TheErrorUsesTheGivenAdvice) {
  const ScratchFolder folder;
  EXPECT_THAT(
      [&] {
        require_free_space(folder.path(), std::uintmax_t{1} << 62, "", {"export", "choose a part"});
      },
      ThrowsMessage<Error>(
          AllOf(HasSubstr("this export may need"), HasSubstr("are free: choose a part"))));
}

}  // namespace
}  // namespace touchdown::experiments
