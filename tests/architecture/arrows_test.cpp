#include <algorithm>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/architecture/house.hpp"
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

Table written_table() { return table_in(text_of(source / "docs/architecture.md")); }

/// Every folder at the top of a room that the table names.
House house() {
  std::set<std::string> top;
  for (const auto& [room, allowed] : written_table()) top.insert(room.substr(0, room.find('/')));
  return house_in(source, top);
}

TEST(Arrows, RunAsTheTableInTheArchitectureSays) {
  const Table table = written_table();
  ASSERT_GT(table.size(), 30U);
  EXPECT_THAT(against(table, house()), IsEmpty());
}

TEST(Arrows, MakeNoCircleOfModules) { EXPECT_THAT(circles(house()), IsEmpty()); }

TEST(Arrows, AreNotAllowedByTheTableInACircleOfRooms) {
  // A row of the table as an include of the room by its own name.
  House rooms;
  for (const auto& [room, allowed] : written_table()) {
    for (const std::string& name : allowed) {
      if (name.ends_with(".hpp") || name.ends_with("/*")) continue;
      rooms.arrows.push_back({room + ".hpp", 1, name + ".hpp"});
    }
  }
  EXPECT_THAT(circles(rooms), IsEmpty());
}

TEST(Rooms, HoldTwelveModulesAtMost) { EXPECT_THAT(crowded(house(), 12), IsEmpty()); }

TEST(Rooms, OfTheTableAllStand) {
  const House standing = house();
  for (const auto& row : written_table()) {
    EXPECT_TRUE(std::any_of(standing.files.begin(), standing.files.end(),
                            [&](const std::string& file) { return room_of(file) == row.first; }))
        << row.first;
  }
}

// The checks themselves, on a house that is broken on purpose.

constexpr const char* small_table =
    "<!-- arrows -->\n| room | says | may include |\n|---|---|---|\n"
    "| `kitchen` | `cellar` is no word of the last column | `cellar` |\n"
    "| `cellar` | | – |\n| `roof` | | `kitchen`, `cellar/wine.hpp` |\n<!-- /arrows -->\n"
    "| `garden` | not a row of the table | `roof` |\n";

TEST(ArrowsTable, IsReadFromItsLastColumn) {
  const Table table = table_in(small_table);
  ASSERT_EQ(table.size(), 3U);
  EXPECT_THAT(table.at("kitchen"), UnorderedElementsAre("cellar"));
  EXPECT_THAT(table.at("cellar"), IsEmpty());
  EXPECT_THAT(table.at("roof"), UnorderedElementsAre("kitchen", "cellar/wine.hpp"));
}

class BrokenHouse : public ::testing::Test {
 protected:
  House built() const { return house_in(folder_.path(), {"cellar", "kitchen", "roof"}); }

  BrokenHouse() {
    folder_.write("cellar/wine.hpp", "#pragma once\n");
    folder_.write("cellar/coal.hpp", "#pragma once\n");
    folder_.write("kitchen/stove.hpp", "#include \"cellar/coal.hpp\"\n");
    folder_.write("roof/tiles.cpp", "#include <vector>\n#include \"cellar/wine.hpp\"\n");
  }

  const ScratchFolder folder_;
};

TEST_F(BrokenHouse, IsWholeBeforeItIsBroken) {
  EXPECT_THAT(against(table_in(small_table), built()), IsEmpty());
  EXPECT_THAT(circles(built()), IsEmpty());
}

TEST_F(BrokenHouse, NamesTheLineThatGoesAgainstTheTable) {
  folder_.write("cellar/wine.hpp", "#pragma once\n\n#include \"kitchen/stove.hpp\"\n");
  folder_.write("roof/tiles.cpp", "#include \"cellar/coal.hpp\"\n");
  EXPECT_THAT(
      against(table_in(small_table), built()),
      ElementsAre(
          "cellar/wine.hpp:3: includes \"kitchen/stove.hpp\", and cellar may not include kitchen",
          "roof/tiles.cpp:1: includes \"cellar/coal.hpp\", and roof may not include cellar"));
}

TEST_F(BrokenHouse, NamesBothEndsOfACircle) {
  folder_.write("cellar/coal.hpp", "#include \"cellar/wine.hpp\"\n");
  folder_.write("cellar/wine.cpp", "#include \"cellar/coal.hpp\"\n");
  EXPECT_THAT(
      circles(built()),
      ElementsAre("cellar/coal.hpp:1: includes \"cellar/wine.hpp\", which includes it in turn",
                  "cellar/wine.cpp:1: includes \"cellar/coal.hpp\", which includes it in turn"));
}

TEST_F(BrokenHouse, CountsTheModulesOfARoom) {
  EXPECT_THAT(crowded(built(), 1), ElementsAre("cellar: holds 2 modules, more than 1"));
}

}  // namespace
}  // namespace touchdown::tests
