#include <cstdio>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "program.hpp"

namespace touchdown::cli {
namespace {

using ::testing::HasSubstr;

/// The completions that bash offers for the last of these words.
std::string offered(const std::filesystem::path& share, const std::string& words) {
  const std::string script = fmt::format(
      "source {}/bash-completion/completions/touchdown; COMP_WORDS=({}); "
      "COMP_CWORD=$((${{#COMP_WORDS[@]}} - 1)); _touchdown; echo -n ${{COMPREPLY[*]}}",
      share.string(), words);
  FILE* pipe = ::popen(fmt::format("bash -c '{}' 2>&1", script).c_str(), "r");
  std::string output;
  for (int letter = std::fgetc(pipe); letter != EOF; letter = std::fgetc(pipe)) {
    output += static_cast<char>(letter);
  }
  EXPECT_EQ(::pclose(pipe), 0) << output;
  return output;
}

struct Manual : ::testing::Test {
  Manual() {
    const Ended ended = touchdown_program("manual share", folder.path());
    EXPECT_EQ(ended.exit_code, 0) << ended.errors;
  }
  ScratchFolder folder;
  std::filesystem::path share = folder.path() / "share";
};

TEST_F(Manual, ReferenceOfTheDocumentsIsThatOfTheProgram) {
  const std::string file = TOUCHDOWN_SOURCE_DIR "/docs/reference/cli.md";
  EXPECT_TRUE(touchdown_program("manual --markdown", folder.path()).output == read_file(file))
      << file << " is out of date; write it with: touchdown manual --markdown";
}

TEST_F(Manual, NeedsAFolderOrAFormat) {
  const Ended ended = touchdown_program("manual", folder.path());
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_THAT(ended.errors, HasSubstr("manual: expected DIR or --markdown"));
}

TEST_F(Manual, BashOffersCommandsFlagsAndKnownNames) {
  EXPECT_EQ(offered(share, "touchdown si"), "simulate");
  EXPECT_EQ(offered(share, "touchdown simulate --sim"), "--simulator");
  EXPECT_EQ(offered(share, "touchdown simulate --simulator bu"), "bullet");
  EXPECT_EQ(offered(share, "touchdown render --layout = side"), "side-by-side");
  EXPECT_EQ(offered(share, "touchdown fit --estimator pha"), "phase");
  EXPECT_EQ(offered(share, "touchdown keys sc"), "scenario");
  EXPECT_EQ(offered(share, "touchdown run experi"), "") << "bash itself completes files";
}

TEST_F(Manual, ZshReadsItsCompletion) {
  const std::string file = (share / "zsh" / "site-functions" / "_touchdown").string();
  if (std::system("command -v zsh >/dev/null") != 0) GTEST_SKIP() << "no zsh here";
  EXPECT_EQ(std::system(("zsh -n " + file).c_str()), 0);
}

}  // namespace
}  // namespace touchdown::cli
