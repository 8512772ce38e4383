#include <cstdio>
#include <regex>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.hpp"

namespace touchdown::cli {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::vector<std::string> kinds = {"experiment", "scenario", "robot",
                                        "sensors",    "mapping",  "training"};

struct Keys : InFolder {
  std::string printed(const std::string& arguments) const {
    return folder_.output_of("keys " + arguments);
  }
};

/// The cells of the rows of a Markdown document's tables, without headers.
std::vector<std::vector<std::string>> rows_of(const std::string& markdown) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(markdown);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("| `")) continue;
    std::vector<std::string> cells;
    std::istringstream parts(line.substr(2));
    for (std::string part; std::getline(parts, part, '|');) {
      const std::size_t end = part.find_last_not_of(' ');
      cells.push_back(end == std::string::npos ? ""
                                               : part.substr(part.find_first_not_of(' '), end));
    }
    rows.push_back(cells);
  }
  return rows;
}

TEST_F(Keys, OfEveryKindHaveAMeaningAndAType) {
  for (const std::string& kind : kinds) {
    const auto rows = rows_of(printed(kind + " --markdown"));
    EXPECT_GT(rows.size(), 10U) << kind;
    std::set<std::string> paths;
    for (const auto& row : rows) {
      ASSERT_EQ(row.size(), 6U) << kind << ": " << row.front();
      EXPECT_NE(row[1], "") << kind << ": " << row.front();
      EXPECT_NE(row[5], "") << kind << ": " << row.front()
                            << " has no .doc(...) where it is described";
      EXPECT_TRUE(paths.insert(row.front()).second) << kind << ": " << row.front() << " twice";
    }
  }
}

TEST_F(Keys, AreTheDocument) {
  EXPECT_TRUE(printed("--markdown") == read_file(std::filesystem::path(TOUCHDOWN_SOURCE_DIR) /
                                                 "docs" / "reference" / "keys.md"))
      << "docs/reference/keys.md is out of date; write it with: touchdown keys --markdown > "
         "docs/reference/keys.md";
}

TEST_F(Keys, ArePrintedForATerminalWithTypeUnitRangeDefaultAndMeaning) {
  const std::string text = printed("experiment");
  EXPECT_THAT(text, StartsWith("Experiment files\n"));
  EXPECT_THAT(
      text, ::testing::ContainsRegex("labels\\.share +number, 0 to 1; default: 0.019\n"
                                     " +A wheel is in contact above this share of the robot's\n"));
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(line.size(), 110U) << line;  // 100 characters, some of two bytes
  }
}

TEST_F(Keys, OfAllKindsArePrintedWithoutAKindAndAnUnknownOneIsRefused) {
  EXPECT_THAT(printed(""), AllOf(HasSubstr("Experiment files\n"), HasSubstr("Mapping files\n"),
                                 HasSubstr("Training files\n")));
  folder_.expect_refusals({{"keys experimnt", {"did you mean 'experiment'?"}}});
}

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

struct Manual : InFolder {
  Manual() { folder_.output_of("manual share"); }
  std::filesystem::path share = folder_ / "share";
};

TEST_F(Manual, ReferenceOfTheDocumentsIsThatOfTheProgram) {
  const std::string file = TOUCHDOWN_SOURCE_DIR "/docs/reference/cli.md";
  EXPECT_TRUE(folder_.output_of("manual --markdown") == read_file(file))
      << file << " is out of date; write it with: touchdown manual --markdown";
  folder_.expect_refusals({{"manual", {"manual: expected DIR or --markdown"}}});
}

TEST_F(Manual, BashOffersCommandsFlagsAndKnownNames) {
  EXPECT_EQ(offered(share, "touchdown si"), "simulate");
  EXPECT_EQ(offered(share, "touchdown simulate --sim"), "--simulator");
  EXPECT_EQ(offered(share, "touchdown simulate --simulator bu"), "bullet");
  EXPECT_EQ(offered(share, "touchdown render --layout = side"), "side-by-side");
  EXPECT_EQ(offered(share, "touchdown fit --estimator mea"), "measurement_only");
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
