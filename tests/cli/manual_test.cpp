#include <cstdio>
#include <regex>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "program.hpp"

namespace touchdown::cli {
namespace {

using ::testing::AllOf;
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

TEST_F(Manual, HasAPageForEveryCommandAndNamesEachOfItsFlags) {
  const std::string help = touchdown_program("--help", folder.path()).output;
  const std::string program_page = read_file(share / "man" / "man1" / "touchdown.1");
  const std::regex verb_line("\n  ([a-z]+)  +touchdown ");
  int verbs = 0;
  for (std::sregex_iterator found(help.begin(), help.end(), verb_line), end; found != end;
       ++found, ++verbs) {
    const std::string verb = found->str(1);
    EXPECT_THAT(program_page, HasSubstr("touchdown\\-" + verb));
    if (verb == "train" || verb == "watch") continue;  // programs of their own have the flags
    const std::string page = read_file(share / "man" / "man1" / ("touchdown-" + verb + ".1"));
    EXPECT_THAT(page, AllOf(HasSubstr(".TH touchdown\\-" + verb), HasSubstr(".SH EXAMPLES")));
    const std::string verb_help = touchdown_program(verb + " --help", folder.path()).output;
    const std::regex flag("--[a-z-]+");
    const std::string flags = verb_help.substr(verb_help.find("Options:"));
    for (std::sregex_iterator name(flags.begin(), flags.end(), flag); name != end; ++name) {
      EXPECT_THAT(page, HasSubstr(std::regex_replace(name->str(), std::regex("-"), "\\-"))) << verb;
    }
  }
  EXPECT_GE(verbs, 10);
}

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
