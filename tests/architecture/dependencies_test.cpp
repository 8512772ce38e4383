#include <algorithm>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "tests/architecture/source_tree.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::tests {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::IsSupersetOf;
using ::testing::SizeIs;

const std::filesystem::path source = TOUCHDOWN_SOURCE_DIR;

std::vector<std::string> written_order() {
  return folder_order_in(read_file(source / "docs/reference/architecture.md"));
}

bool is_of_product(const std::string& file) {
  return !file.starts_with("examples/") && !file.starts_with("tests/");
}

/// All sources of the product.
SourceTree product() {
  SourceTree tree = source_tree_in(source, written_order());
  std::erase_if(tree.files, [](const std::string& file) { return !is_of_product(file); });
  std::erase_if(tree.includes, [](const Include& include) { return !is_of_product(include.from); });
  return tree;
}

TEST(Folders, AreThoseOfTheArchitecture) {
  const std::vector<std::string> order = written_order();
  EXPECT_THAT(order, SizeIs(16));
  for (const std::string& folder : order) {
    EXPECT_TRUE(std::filesystem::is_directory(source / folder)) << folder;
  }
  for (const auto& entry : std::filesystem::directory_iterator(source)) {
    const std::string name = entry.path().filename().string();
    if (!entry.is_directory() || name[0] == '.' || name == "build" || name == "runs") continue;
    if (source_tree_in(source, {name}).files.empty()) continue;  // not of the project
    EXPECT_THAT(order, Contains(name));
  }
}

TEST(Includes, FollowTheOrderOfTheFolders) {
  EXPECT_THAT(includes_against(written_order(), product()), IsEmpty());
}

TEST(Includes, FormNoCycleOfModules) { EXPECT_THAT(cyclic_includes(product()), IsEmpty()); }

TEST(Includes, OfTheEstimatorNeedThreeHeadersOfThisProjectAlone) {
  std::set<std::string> outside;
  for (const Include& include : product().includes) {
    if (include.from.starts_with("estimator/") && !include.to.starts_with("estimator/")) {
      outside.insert(include.to);
    }
  }
  EXPECT_THAT((std::set<std::string>{"core/error.hpp", "core/fingerprint.hpp", "core/nearest.hpp"}),
              IsSupersetOf(outside));
}

// The checks themselves, on a small source tree that breaks the rules.

TEST(FolderOrder, IsReadFromTheFirstColumnOfItsTable) {
  EXPECT_THAT(folder_order_in("| `garden` | not a row of the table |\n<!-- folders -->\n"
                              "| folder | contents |\n|---|---|\n| `cellar` | `wine` |\n"
                              "| `kitchen` | |\n<!-- /folders -->\n| `roof` | |\n"),
              ElementsAre("cellar", "kitchen"));
}

class SmallSourceTree : public ::testing::Test {
 protected:
  SmallSourceTree() {
    folder_.write("cellar/wine.hpp", "#pragma once\n");
    folder_.write("cellar/coal.hpp", "#pragma once\n");
    folder_.write("kitchen/stove.hpp", "#include \"cellar/coal.hpp\"\n");
    folder_.write("roof/tiles.cpp", "#include <vector>\n#include \"cellar/wine.hpp\"\n");
  }

  SourceTree tree() const { return source_tree_in(folder_.path(), {"cellar", "kitchen", "roof"}); }

  const std::vector<std::string> order_ = {"cellar", "kitchen", "roof"};
  const ScratchFolder folder_;
};

TEST_F(SmallSourceTree, BreaksNoRuleAtFirst) {
  EXPECT_THAT(includes_against(order_, tree()), IsEmpty());
  EXPECT_THAT(cyclic_includes(tree()), IsEmpty());
}

TEST_F(SmallSourceTree, ReportsEachIncludeOfAFolderBelow) {
  folder_.write("cellar/wine.hpp", "#pragma once\n\n#include \"kitchen/stove.hpp\"\n");
  EXPECT_THAT(includes_against(order_, tree()),
              ElementsAre("cellar/wine.hpp:3: includes \"kitchen/stove.hpp\", and kitchen stands "
                          "below cellar"));
  EXPECT_THAT(includes_against({"cellar", "kitchen"}, tree()),
              ElementsAre("roof/tiles.cpp: its folder has no row",
                          "cellar/wine.hpp:3: includes \"kitchen/stove.hpp\", and kitchen stands "
                          "below cellar"));
}

TEST_F(SmallSourceTree, ReportsBothIncludesOfACycle) {
  folder_.write("cellar/coal.hpp", "#include \"cellar/wine.hpp\"\n");
  folder_.write("cellar/wine.cpp", "#include \"cellar/coal.hpp\"\n");
  EXPECT_THAT(
      cyclic_includes(tree()),
      ElementsAre("cellar/coal.hpp:1: includes \"cellar/wine.hpp\", which includes it in turn",
                  "cellar/wine.cpp:1: includes \"cellar/coal.hpp\", which includes it in turn"));
}

}  // namespace
}  // namespace touchdown::tests
