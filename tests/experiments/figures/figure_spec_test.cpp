#include "experiments/figures/figure_spec.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace touchdown::experiments {
namespace {

using ::testing::ElementsAre;

const Table table =
    table_of(from_csv("engine,source,height,share\n"
                      "m,truth,0.5,1\n"
                      "m,loads,0.5,0.75\n"
                      "m,truth,0.7,nan\n"
                      "m,loads,0.7,0.5\n"
                      "b,truth,0.5,0.125\n"));

std::string upper(const std::string& name) { return name == "m" ? "M" : "B"; }

TEST(FigureGroups, AreTheDistinctValuesInTheOrderOfTheRows) {
  const FigureGroups engines = groups_in(table, "engine", upper);
  ASSERT_EQ(engines.groups.size(), 2U);
  EXPECT_THAT(engines.groups[0].values, ElementsAre("m"));
  EXPECT_EQ(engines.groups[0].title, "M");
  EXPECT_EQ(engines.groups[1].title, "B");
}

TEST(FigureGroups, AreThoseOfTheRowsThatPassTheFilter) {
  const FigureGroups groups = combinations_in(
      table, {"engine", "source"}, [](const auto& values) { return values[0] + values[1]; },
      {{"height", "0.7"}});
  ASSERT_EQ(groups.groups.size(), 2U);
  EXPECT_EQ(groups.groups[0].title, "mtruth");
  EXPECT_EQ(groups.groups[1].title, "mloads");
  EXPECT_EQ(group_of(groups, TableRow(table, 1)), 1U);
  EXPECT_FALSE(group_of(groups, TableRow(table, 4)).has_value());
}

TEST(FigureGroups, WithoutColumnsHoldAllRows) { EXPECT_EQ(group_of({}, TableRow(table, 4)), 0U); }

TEST(FigureAxis, TransformsValuesAndRaisesThemToItsFloor) {
  const FigureAxis error{
      .column = "share", .title = "error", .factor = -100.0, .offset = 100.0, .floor = 10.0};
  EXPECT_EQ(drawn_value(error, TableRow(table, 1)), 25.0);
  EXPECT_EQ(drawn_value(error, TableRow(table, 0)), 10.0);
  EXPECT_TRUE(std::isnan(drawn_value(error, TableRow(table, 2))));
}

TEST(FigureText, ListsTheValuesOfEachPanelAndSeries) {
  FigureSpec spec;
  spec.panels = groups_in(table, "engine", upper);
  spec.series = groups_in(table, "source", [](const auto& name) { return name; });
  spec.x = {.column = "height", .title = "height", .unit = "m"};
  spec.measures = {{.column = "share", .title = "share"}};
  EXPECT_EQ(values_text(spec, table),
            " M, truth: 1 at 0.5 m; loads: 0.75 at 0.5 m, 0.5 at 0.7 m. B, truth: 0.125 at 0.5 m.");
}

TEST(FigureText, NamesTheRows) {
  FigureSpec spec;
  spec.where = {{"height", "0.5"}};
  spec.series = groups_in(table, "engine", upper);
  spec.rows = groups_in(table, "source", [](const auto& name) { return name; });
  spec.measures = {{.column = "share", .title = "share", .unit = "m"}};
  EXPECT_EQ(values_text(spec, table), " M: 1 m for truth, 0.75 m for loads; B: 0.125 m for truth.");
}

}  // namespace
}  // namespace touchdown::experiments
