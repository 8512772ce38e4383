#include "render/figures/iso_lines.hpp"

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
  EXPECT_EQ(label_of(borders[0]), "2 %");
  EXPECT_EQ(label_of(borders[1]), "5, 10 %");
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
  const std::vector<IsoLine> parts = without_label(borders[0], high);
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_THAT(parts[0].front(), ElementsAre(0.5, -0.5));
  EXPECT_THAT(parts[1].back(), ElementsAre(0.5, 0.5));
  const double gap = high.height * (parts[1].front()[1] - parts[0].back()[1]);
  EXPECT_GT(gap, 15.0);  // "2 %"
  EXPECT_LT(gap, 25.0);
}

TEST(LevelBorders, KeepAwayFromUnknownCells) {
  EXPECT_TRUE(level_borders({{1.0, NAN, 3.0}}, {2.0}, usual_cell).empty());
  EXPECT_TRUE(level_borders({}, {2.0}, usual_cell).empty());
  EXPECT_TRUE(level_borders({{1.0, 1.5}}, {2.0}, usual_cell).empty());
}

/// A circle's iso-line lies on the circle, up to the error of linear interpolation.
TEST(IsoLines, LieOnTheLevel) {
  std::vector<std::vector<double>> rows(41, std::vector<double>(41));
  for (std::size_t r = 0; r < 41; ++r) {
    for (std::size_t c = 0; c < 41; ++c) {
      rows[r][c] = std::hypot(static_cast<double>(r) - 20.0, static_cast<double>(c) - 20.0);
    }
  }
  const auto segments = iso_lines(rows, 12.3);
  double length = 0.0;
  for (const IsoSegment& segment : segments) {
    for (const auto& point : segment) {
      EXPECT_NEAR(std::hypot(point[0] - 20.0, point[1] - 20.0), 12.3, 0.02);
    }
    length += std::hypot(segment[0][0] - segment[1][0], segment[0][1] - segment[1][1]);
  }
  EXPECT_NEAR(length, 2.0 * M_PI * 12.3, 0.3);
}

TEST(IsoLines, AreJoinedFromEndToEnd) {
  std::vector<std::vector<double>> rows(21, std::vector<double>(21));
  for (std::size_t r = 0; r < 21; ++r) {
    for (std::size_t c = 0; c < 21; ++c) {
      rows[r][c] = std::hypot(static_cast<double>(r) - 10.0, static_cast<double>(c) - 10.0);
    }
  }
  const auto closed = joined(iso_lines(rows, 6.3));
  ASSERT_EQ(closed.size(), 1u);
  EXPECT_EQ(closed[0].size(), iso_lines(rows, 6.3).size() + 1);
  EXPECT_NEAR(closed[0].front()[0], closed[0].back()[0], 1e-9);
  EXPECT_NEAR(closed[0].front()[1], closed[0].back()[1], 1e-9);
  const auto corners = joined(iso_lines(rows, 12.2));  // cut off by the border
  ASSERT_EQ(corners.size(), 4u);
  std::size_t segments = 0;
  for (const IsoLine& line : corners) segments += line.size() - 1;
  EXPECT_EQ(segments, iso_lines(rows, 12.2).size());
  EXPECT_TRUE(joined({}).empty());
}

TEST(IsoLines, SeparateTheCornersOfASaddle) {
  // The middle (0.5) is below 0.6: the two high corners are cut off from each other.
  const auto segments = iso_lines({{1.0, 0.0}, {0.0, 1.0}}, 0.6);
  ASSERT_EQ(segments.size(), 2u);
  for (const IsoSegment& segment : segments) {
    const double x = 0.5 * (segment[0][0] + segment[1][0]);
    const double y = 0.5 * (segment[0][1] + segment[1][1]);
    EXPECT_NEAR(x, y, 1e-12);               // on the diagonal through the high corners
    EXPECT_LT(std::min(x, 1.0 - x), 0.25);  // close to one of them
  }
}

TEST(IsoLines, SkipUnknownCells) {
  EXPECT_TRUE(iso_lines({{0.0, NAN}, {1.0, 1.0}}, 0.5).empty());
  EXPECT_TRUE(iso_lines({}, 0.5).empty());
  EXPECT_TRUE(iso_lines({{0.0, 1.0}}, 0.5).empty());
}

}  // namespace
}  // namespace touchdown::render
