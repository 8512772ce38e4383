#include <algorithm>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/architecture/source_tree.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::tests {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

const std::filesystem::path source = TOUCHDOWN_SOURCE_DIR;

std::string text_of(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

DependencyTable written_table() {
  return dependency_table_in(text_of(source / "docs/reference/architecture.md"));
}

/// All sources below the top-level folders of the table.
SourceTree source_tree() {
  std::set<std::string> top;
  for (const auto& [folder, allowed] : written_table()) {
    top.insert(folder.substr(0, folder.find('/')));
  }
  return source_tree_in(source, top);
}

TEST(Includes, FollowTheTableInTheArchitecture) {
  const DependencyTable table = written_table();
  ASSERT_GT(table.size(), 30U);
  EXPECT_THAT(forbidden_includes(table, source_tree()), IsEmpty());
}

TEST(Includes, FormNoCycleOfModules) { EXPECT_THAT(cyclic_includes(source_tree()), IsEmpty()); }

TEST(Includes, ThatTheTableAllowsFormNoCycleOfFolders) {
  // Each folder becomes one file, which includes every folder of its row.
  SourceTree folders;
  for (const auto& [folder, allowed] : written_table()) {
    for (const std::string& name : allowed) {
      if (name.ends_with(".hpp") || name.ends_with("/*")) continue;
      folders.includes.push_back({folder + ".hpp", 1, name + ".hpp"});
    }
  }
  EXPECT_THAT(cyclic_includes(folders), IsEmpty());
}

TEST(Folders, HoldTwelveModulesAtMost) {
  EXPECT_THAT(crowded_folders(source_tree(), 12), IsEmpty());
}

TEST(Folders, OfTheTableAllExist) {
  const SourceTree tree = source_tree();
  for (const auto& row : written_table()) {
    EXPECT_TRUE(std::any_of(tree.files.begin(), tree.files.end(), [&](const std::string& file) {
      return folder_of(file) == row.first;
    })) << row.first;
  }
}

// The checks themselves, on a small source tree that breaks the rules.

constexpr const char* small_table =
    "<!-- dependencies -->\n| folder | contents | may include |\n|---|---|---|\n"
    "| `kitchen` | `cellar` is not in the last column | `cellar` |\n"
    "| `cellar` | | – |\n| `roof` | | `kitchen`, `cellar/wine.hpp` |\n<!-- /dependencies -->\n"
    "| `garden` | not a row of the table | `roof` |\n";

TEST(DependencyTableOfMarkdown, IsReadFromItsLastColumn) {
  const DependencyTable table = dependency_table_in(small_table);
  ASSERT_EQ(table.size(), 3U);
  EXPECT_THAT(table.at("kitchen"), UnorderedElementsAre("cellar"));
  EXPECT_THAT(table.at("cellar"), IsEmpty());
  EXPECT_THAT(table.at("roof"), UnorderedElementsAre("kitchen", "cellar/wine.hpp"));
}

class SmallSourceTree : public ::testing::Test {
 protected:
  SourceTree tree() const { return source_tree_in(folder_.path(), {"cellar", "kitchen", "roof"}); }

  SmallSourceTree() {
    folder_.write("cellar/wine.hpp", "#pragma once\n");
    folder_.write("cellar/coal.hpp", "#pragma once\n");
    folder_.write("kitchen/stove.hpp", "#include \"cellar/coal.hpp\"\n");
    folder_.write("roof/tiles.cpp", "#include <vector>\n#include \"cellar/wine.hpp\"\n");
  }

  const ScratchFolder folder_;
};

TEST_F(SmallSourceTree, FollowsTheTableAtFirst) {
  EXPECT_THAT(forbidden_includes(dependency_table_in(small_table), tree()), IsEmpty());
  EXPECT_THAT(cyclic_includes(tree()), IsEmpty());
}

TEST_F(SmallSourceTree, ReportsEachForbiddenInclude) {
  folder_.write("cellar/wine.hpp", "#pragma once\n\n#include \"kitchen/stove.hpp\"\n");
  folder_.write("roof/tiles.cpp", "#include \"cellar/coal.hpp\"\n");
  EXPECT_THAT(
      forbidden_includes(dependency_table_in(small_table), tree()),
      ElementsAre(
          "cellar/wine.hpp:3: includes \"kitchen/stove.hpp\", and cellar may not include kitchen",
          "roof/tiles.cpp:1: includes \"cellar/coal.hpp\", and roof may not include cellar"));
}

TEST_F(SmallSourceTree, ReportsBothIncludesOfACycle) {
  folder_.write("cellar/coal.hpp", "#include \"cellar/wine.hpp\"\n");
  folder_.write("cellar/wine.cpp", "#include \"cellar/coal.hpp\"\n");
  EXPECT_THAT(
      cyclic_includes(tree()),
      ElementsAre("cellar/coal.hpp:1: includes \"cellar/wine.hpp\", which includes it in turn",
                  "cellar/wine.cpp:1: includes \"cellar/coal.hpp\", which includes it in turn"));
}

TEST_F(SmallSourceTree, CountsTheModulesOfAFolder) {
  EXPECT_THAT(crowded_folders(tree(), 1), ElementsAre("cellar: holds 2 modules, more than 1"));
}

}  // namespace
}  // namespace touchdown::tests
