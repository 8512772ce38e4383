#include "render/studies/worst_segments.hpp"

#include <gtest/gtest.h>

namespace touchdown::render {
namespace {

void expect_segment(const std::vector<std::vector<int>>& wrong, std::size_t length, std::size_t run,
                    std::size_t begin, std::int64_t count) {
  const WorstSegment segment = worst_segment(wrong, length);
  EXPECT_EQ(segment.run, run);
  EXPECT_EQ(segment.begin, begin);
  EXPECT_EQ(segment.wrong, count);
}

TEST(WorstSegment, HasTheMostWrongDecisions) {
  expect_segment({{0, 1, 0, 0, 2, 1, 0}, {1, 0, 0, 0, 0, 0, 1}}, 2, 0, 4, 3);
  expect_segment({{0, 1, 0, 0}, {0, 0, 2, 2}}, 2, 1, 2, 4);
}

TEST(WorstSegment, IsTheFirstOfEqualOnesAndTheBeginningWithoutErrors) {
  expect_segment({{0, 1, 1, 0, 1, 1}, {1, 1, 0, 0, 0, 0}}, 2, 0, 1, 2);
  expect_segment({{0, 0, 0}, {0, 0, 0}}, 2, 0, 0, 0);
}

TEST(WorstSegment, IsTheWholeOfAShorterRun) { expect_segment({{1, 0}, {2, 1, 1}}, 5, 1, 0, 4); }

}  // namespace
}  // namespace touchdown::render
