#include "render/pictures/worst_segments.hpp"

#include <gtest/gtest.h>

namespace touchdown::render {
namespace {

void expect_moment(const std::vector<std::vector<int>>& wrong, std::size_t length, std::size_t run,
                   std::size_t begin, std::int64_t count) {
  const WorstSegment moment = worst_segment(wrong, length);
  EXPECT_EQ(moment.run, run);
  EXPECT_EQ(moment.begin, begin);
  EXPECT_EQ(moment.wrong, count);
}

TEST(WorstSegment, IsWhereMostIsWrongInARow) {
  expect_moment({{0, 1, 0, 0, 2, 1, 0}, {1, 0, 0, 0, 0, 0, 1}}, 2, 0, 4, 3);
  expect_moment({{0, 1, 0, 0}, {0, 0, 2, 2}}, 2, 1, 2, 4);
}

TEST(WorstSegment, IsTheFirstOfThemAndTheBeginningOfWhoIsNeverWrong) {
  expect_moment({{0, 1, 1, 0, 1, 1}, {1, 1, 0, 0, 0, 0}}, 2, 0, 1, 2);
  expect_moment({{0, 0, 0}, {0, 0, 0}}, 2, 0, 0, 0);
}

TEST(WorstSegment, OfARunThatIsShorterIsAllOfIt) { expect_moment({{1, 0}, {2, 1, 1}}, 5, 1, 0, 4); }

}  // namespace
}  // namespace touchdown::render
