#include "core/keys/value_text.hpp"

#include <gtest/gtest.h>

namespace touchdown {
namespace {

TEST(ValueText, IsTheShortestYamlOnOneLine) {
  EXPECT_EQ(value_text(YAML::Node(0.1)), "0.1");
  EXPECT_EQ(value_text(YAML::Node(1.0 / 3.0)), "0.3333333333333333");
  EXPECT_EQ(value_text(YAML::Node(true)), "true");
  EXPECT_EQ(value_text(YAML::Node("")), "\"\"");
  EXPECT_EQ(value_text(YAML::Node(std::vector<double>{})), "[]");
  EXPECT_EQ(value_text(YAML::Load("[{a: 1.50, b: [x, y]}]")), "[{a: 1.5, b: [x, y]}]");
}

TEST(ValueText, OfANumberThatIsNotFiniteIsNone) {
  EXPECT_EQ(value_text(YAML::Load(".inf")), "none");
  EXPECT_EQ(value_text(YAML::Load(".nan")), "none");
}

TEST(RangeText, LeavesOutALimitThatOnlyExcludesAbsurdNumbers) {
  EXPECT_EQ(range_text(-1.0, 0.5), "-1 to 0.5");
  EXPECT_EQ(range_text(0.0, 1e15), "≥ 0");
}

}  // namespace
}  // namespace touchdown
