#include <algorithm>
#include <regex>

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

constexpr std::size_t most_lines = 400;

bool is_of_product(const std::string& file) {
  return !file.starts_with("examples/") && !file.starts_with("tests/");
}

/// All sources of the product. Tests and examples may be as long as they like.
SourceTree product() {
  SourceTree tree = source_tree_in(source, written_order());
  std::erase_if(tree.files, [](const SourceFile& file) { return !is_of_product(file.name); });
  std::erase_if(tree.includes, [](const Include& include) { return !is_of_product(include.from); });
  return tree;
}

/// The headers that the estimator library installs, as its install.cmake lists them.
std::set<std::string> installed_headers() {
  const std::string text = read_file(source / "estimator/install.cmake");
  std::set<std::string> headers;
  static const std::regex name(R"([a-z0-9_]+(/[a-z0-9_]+)*)");
  for (std::sregex_iterator one(text.begin(), text.end(), name), end; one != end; ++one) {
    headers.insert("estimator/" + one->str() + ".hpp");
  }
  return headers;
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

TEST(Includes, OfTheEstimatorNeedNothingOfThisProjectButErrorsAndFingerprints) {
  std::set<std::string> outside;
  for (const Include& include : product().includes) {
    if (include.from.starts_with("estimator/") && !include.to.starts_with("estimator/")) {
      outside.insert(include.to);
    }
  }
  EXPECT_THAT((std::set<std::string>{"core/error.hpp", "core/fingerprint.hpp"}),
              IsSupersetOf(outside));
}

TEST(Files, HoldFourHundredLinesAtMost) {
  EXPECT_THAT(long_files(product(), most_lines), IsEmpty());
}

TEST(Headers, HaveTwoReadersOrAreInstalled) {
  SourceTree tree = product();  // with the tests and examples as readers
  tree.includes = source_tree_in(source, written_order()).includes;
  std::set<std::string> exempt = installed_headers();
  exempt.insert("experiments/results/estimates.hpp");  // users' studies print their tables by it
  EXPECT_THAT(headers_with_one_reader(tree, most_lines, exempt), IsEmpty());
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
  EXPECT_THAT(long_files(tree(), 2), IsEmpty());
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

TEST_F(SmallSourceTree, ReportsLongFiles) {
  EXPECT_THAT(long_files(tree(), 1), ElementsAre("roof/tiles.cpp: 2 lines"));
}

TEST_F(SmallSourceTree, ReportsHeadersWithOneReader) {
  folder_.write("roof/gutter.cpp", "#include \"cellar/wine.hpp\"\n");
  EXPECT_THAT(headers_with_one_reader(tree(), 10, {}),
              ElementsAre("cellar/coal.hpp: only kitchen/stove includes it",
                          "kitchen/stove.hpp: no module includes it"));
  EXPECT_THAT(headers_with_one_reader(tree(), 10, {"cellar/coal.hpp", "kitchen/stove.hpp"}),
              IsEmpty());
  folder_.write("cellar/coal.cpp", "#include \"cellar/coal.hpp\"\n\n\n\n\n\n");
  folder_.write("kitchen/stove.cpp", "#include \"kitchen/stove.hpp\"\n\n\n\n\n\n");
  EXPECT_THAT(headers_with_one_reader(tree(), 10, {}),
              ElementsAre("kitchen/stove.hpp: no module includes it"))
      << "both together are too long";
}

}  // namespace
}  // namespace touchdown::tests
