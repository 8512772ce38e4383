#include "core/csv.hpp"

#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace touchdown {
namespace {

using ::testing::ElementsAre;

std::vector<std::string> texts_of(const CsvRows& rows) {
  std::vector<std::string> texts;
  for (const CsvCell& cell : rows.cells()) texts.push_back(content_of(cell));
  return texts;
}

TEST(CsvRows, HaveCellsWithTheirPlaces) {
  std::istringstream text(
      "\xef\xbb\xbf"
      "a, \"b,\"\"c\"\"\" ,d\r\n\nlast");
  CsvRows rows(text);
  ASSERT_TRUE(rows.next());
  EXPECT_EQ(rows.line(), 1U);
  EXPECT_THAT(texts_of(rows), ElementsAre("a", "b,\"c\"", "d\r"));
  EXPECT_EQ(rows.cells()[1].column, 4U);
  EXPECT_EQ(rows.cells()[2].column, 15U);
  ASSERT_TRUE(rows.next());
  EXPECT_THAT(texts_of(rows), ElementsAre(""));
  ASSERT_TRUE(rows.next());
  EXPECT_EQ(rows.line(), 3U);
  EXPECT_THAT(texts_of(rows), ElementsAre("last"));
  EXPECT_FALSE(rows.next());
}

TEST(CsvRows, OfAnEmptyTextAreOneEmptyCell) {
  std::istringstream text("");
  CsvRows rows(text);
  ASSERT_TRUE(rows.next());
  EXPECT_THAT(texts_of(rows), ElementsAre(""));
  EXPECT_FALSE(rows.next());
}

TEST(CsvRows, MayContinueAQuoteOnTheNextLine) {
  std::istringstream text("a,\"two\nlines\",c\nd");
  CsvRows rows(text);
  ASSERT_TRUE(rows.next());
  EXPECT_TRUE(rows.is_open());
  ASSERT_TRUE(rows.append_line());
  EXPECT_FALSE(rows.is_open());
  EXPECT_THAT(texts_of(rows), ElementsAre("a", "two\nlines", "c"));
  EXPECT_EQ(rows.line(), 1U);
  ASSERT_TRUE(rows.next());
  EXPECT_EQ(rows.line(), 3U);
  EXPECT_FALSE(rows.append_line());
}

}  // namespace
}  // namespace touchdown
