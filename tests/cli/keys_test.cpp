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
    return folder_.output_of("list " + arguments);
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
  EXPECT_TRUE(printed("keys --markdown") == read_file(std::filesystem::path(TOUCHDOWN_SOURCE_DIR) /
                                                      "docs" / "reference" / "keys.md"))
      << "docs/reference/keys.md is out of date; write it with: touchdown list keys --markdown > "
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
  EXPECT_THAT(printed("keys"), AllOf(HasSubstr("Experiment files\n"), HasSubstr("Mapping files\n"),
                                     HasSubstr("Training files\n")));
  folder_.expect_refusals({{"list experimnt", {"did you mean 'experiment'?"}}});
}

using Commands = InFolder;

TEST_F(Commands, AreTheDocument) {
  const std::string file = TOUCHDOWN_SOURCE_DIR "/docs/reference/cli.md";
  EXPECT_TRUE(folder_.output_of("list commands --markdown") == read_file(file))
      << file << " is out of date; write it with: touchdown list commands --markdown";
}

TEST_F(Commands, ThatWentNameTheirSuccessor) {
  folder_.expect_refusals({{"keys experiment", {"'keys' is gone: use 'touchdown list KIND'"}},
                           {"manual share", {"touchdown list commands"}},
                           {"export a.mpack -o b.mcap", {"touchdown convert"}},
                           {"figure a error", {"touchdown report RUN --figure NAME"}},
                           {"clean --dry-run", {"rm -r runs/NAME/ID"}}});
}

}  // namespace
}  // namespace touchdown::cli
