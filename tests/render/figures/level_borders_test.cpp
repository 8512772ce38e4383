#include "render/figures/level_borders.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace touchdown::render {
namespace {

using ::testing::ElementsAre;

/// Of fine maps (px).
constexpr CellSize usual_cell{27.0, 22.0};

using Rows = std::vector<std::vector<double>>;

/// Falls from the middle outwards.
Rows hill(std::size_t side) {
  Rows rows(side, std::vector<double>(side));
  const double middle = 0.5 * static_cast<double>(side - 1);
  for (std::size_t r = 0; r < side; ++r) {
    for (std::size_t c = 0; c < side; ++c) {
      rows[r][c] =
          20.0 - 2.1 * std::hypot(static_cast<double>(r) - middle, static_cast<double>(c) - middle);
    }
  }
  return rows;
}

/// The number of edges between a value below a level and one above it, counted without lines.
std::size_t edges_between(const Rows& rows, const std::vector<double>& levels) {
  std::size_t edges = 0;
  const auto apart = [&](double a, double b) {
    for (const double level : levels) {
      if ((a < level) != (b < level)) return std::size_t{1};
    }
    return std::size_t{0};
  };
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (std::size_t c = 0; c < rows[r].size(); ++c) {
      if (c + 1 < rows[r].size()) edges += apart(rows[r][c], rows[r][c + 1]);
      if (r + 1 < rows.size()) edges += apart(rows[r][c], rows[r + 1][c]);
    }
  }
  return edges;
}

TEST(LevelBorders, RunAlongCellsEdgesAndCoverEveryOneOnce) {
  const Rows rows = hill(13);
  std::size_t segments = 0;
  for (const LevelBorder& border : level_borders(rows, {5.0, 10.0, 15.0}, usual_cell)) {
    segments += border.line.size() - 1;
    for (std::size_t i = 0; i < border.line.size(); ++i) {
      // Corners are between cells; cells have whole coordinates.
      EXPECT_EQ(std::abs(border.line[i][0] - std::floor(border.line[i][0])), 0.5);
      EXPECT_EQ(std::abs(border.line[i][1] - std::floor(border.line[i][1])), 0.5);
      if (i == 0) continue;
      const double dx = std::abs(border.line[i][0] - border.line[i - 1][0]);
      const double dy = std::abs(border.line[i][1] - border.line[i - 1][1]);
      EXPECT_EQ(dx + dy, 1.0);
      EXPECT_EQ(dx * dy, 0.0);
    }
  }
  EXPECT_EQ(segments, edges_between(rows, {5.0, 10.0, 15.0}));
}

TEST(LevelBorders, LabelEveryLevelBetweenTheirTwoSides) {
  const auto borders = level_borders({{1.5, 3.0, 12.0}}, {1.0, 2.0, 5.0, 10.0}, usual_cell);
  ASSERT_EQ(borders.size(), 2U);
  EXPECT_EQ(label_of(borders[0]), "98 %");
  EXPECT_EQ(label_of(borders[1]), "90–95 %");
  EXPECT_THAT(borders[0].line, ElementsAre(ElementsAre(0.5, -0.5), ElementsAre(0.5, 0.5)));
  ASSERT_TRUE(borders[0].labelled.has_value());
  const LabelPlace place = label_place(borders[0]);
  EXPECT_EQ(place.x, 0.5);
  EXPECT_EQ(place.y, 0.0);
  EXPECT_TRUE(place.upright);
}

TEST(LevelBorders, LabelsKeepApartAndTheLongestLineHasOne) {
  const auto borders = level_borders(hill(13), {5.0, 6.0, 10.0, 11.0, 15.0}, usual_cell);
  ASSERT_TRUE(borders.front().labelled.has_value());
  for (std::size_t i = 0; i < borders.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (!borders[i].labelled || !borders[k].labelled) continue;
      const LabelPlace a = label_place(borders[i]), b = label_place(borders[k]);
      EXPECT_GE(
          std::max(usual_cell.width * std::abs(a.x - b.x), usual_cell.height * std::abs(a.y - b.y)),
          30.0);
    }
  }
}

TEST(LevelBorders, LeaveGapsForTheirLabels) {
  const CellSize high{10.0, 100.0};
  const auto borders = level_borders({{1.0, 3.0}}, {2.0}, high);
  ASSERT_EQ(borders.size(), 1U);
  const std::vector<BorderLine> parts = without_label(borders[0], high);
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_THAT(parts[0].front(), ElementsAre(0.5, -0.5));
  EXPECT_THAT(parts[1].back(), ElementsAre(0.5, 0.5));
  const double gap = high.height * (parts[1].front()[1] - parts[0].back()[1]);
  EXPECT_GT(gap, 15.0);  // "98 %"
  EXPECT_LT(gap, 32.0);
}

TEST(LevelBorders, KeepAwayFromUnknownCells) {
  EXPECT_TRUE(level_borders({{1.0, NAN, 3.0}}, {2.0}, usual_cell).empty());
  EXPECT_TRUE(level_borders({}, {2.0}, usual_cell).empty());
  EXPECT_TRUE(level_borders({{1.0, 1.5}}, {2.0}, usual_cell).empty());
}

}  // namespace
}  // namespace touchdown::render
