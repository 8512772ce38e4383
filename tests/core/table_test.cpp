#include "core/table.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/columns.hpp"
#include "core/rows.hpp"

namespace touchdown {
namespace {

using ::testing::ElementsAre;

TEST(Csv, QuotesWhatWouldBreakALine) {
  EXPECT_EQ(to_csv(TextTable{{"a", "b"}, {{"x,y", "a \"b\""}, {"1", "2"}}}),
            "a,b\n\"x,y\",\"a \"\"b\"\"\"\n1,2\n");
}

TEST(Csv, IsReadAsItWasWritten) {
  const TextTable table{{"a", "b,\"c\""}, {{"1", "two\nlines"}, {"", "x"}}};
  const TextTable read = from_csv(to_csv(table));
  EXPECT_EQ(read.header, table.header);
  EXPECT_EQ(read.rows, table.rows);
  EXPECT_TRUE(from_csv("").header.empty());
  EXPECT_EQ(from_csv("x,y\n1.5\n").rows, (std::vector<std::vector<std::string>>{{"1.5", ""}}));
}

TEST(TextTable, AlignsByCharactersNotBytes) {
  EXPECT_EQ(to_text(TextTable{{"name", "v"}, {{"m/s²", "10"}, {"a", "±1"}}}),
            "  name    v\n  ────   ──\n  m/s²   10\n  a      ±1\n");
  EXPECT_EQ(to_text(TextTable{{}, {{"a", "b"}, {"cc", "d"}}}, 2), "  a    b\n  cc   d\n");
}

TEST(Numbers, ReadBackExactlyAndMarkUndefinedValues) {
  EXPECT_EQ(exact(0.25), "0.25");
  EXPECT_EQ(std::stod(exact(0.1 + 0.2)), 0.1 + 0.2);
  EXPECT_EQ(metric(2.0 / 3.0), "0.666667");
  EXPECT_EQ(metric(NAN), "nan");
  EXPECT_EQ(with_interval({0.5, 0.25, 0.75}, 2), "0.50 [0.25, 0.75]");
  EXPECT_EQ(with_interval({NAN, NAN, NAN}), "–");
}

TEST(Csv, MarksTextsThatSpreadsheetsWouldCompute) {
  const std::vector<std::string> harmful = {
      "=1+1", "+cmd|' /C calc'!A0", "-2+3", "@SUM(A1)", "\t=1", "\r=1", "'=1", "=\"a\",\"b\""};
  for (const std::string& cell : harmful) {
    const std::string csv = to_csv(TextTable{{"name"}, {{cell}}});
    const std::string second = csv.substr(csv.find('\n') + 1);
    EXPECT_TRUE(second.starts_with('\'') || second.starts_with("\"'")) << csv;
    EXPECT_EQ(from_csv(csv).rows.at(0).at(0), cell) << csv;
  }
  // Numbers, dashes and other texts are as they are.
  for (const std::string cell : {"-1.5", "+2", "-1e-9", "-inf", "nan", "-", "–", "a=b", "'tis"}) {
    EXPECT_EQ(to_csv(TextTable{{"x"}, {{cell}}}), "x\n" + cell + "\n");
    EXPECT_EQ(from_csv("x\n" + cell + "\n").rows.at(0).at(0), cell);
  }
}

TEST(Fixed, HasNoNegativeZero) {
  EXPECT_EQ(fixed(-0.0, 1), "0.0");
  EXPECT_EQ(fixed(-0.04, 1), "0.0");
  EXPECT_EQ(fixed(-0.06, 1), "-0.1");
  EXPECT_EQ(fixed(-0.4, 0), "0");
  EXPECT_EQ(fixed(-10.0, 1), "-10.0");
  EXPECT_EQ(metric(-1e-9), "0.000000");
  EXPECT_EQ(with_interval({-0.0001, -0.0002, 0.0001}), "0.000 [0.000, 0.000]");
}

TEST(Fixed, IsShortBeyondAnyQuantity) {
  EXPECT_EQ(fixed(999999999999999872.0, 3), "1e+18");
  EXPECT_EQ(fixed(-3e300, 0), "-3e+300");
  EXPECT_EQ(fixed(1.7e9, 3), "1700000000.000");
}

TEST(Readable, HasNoPowerOfTenWherePeopleUseNone) {
  const std::tuple<double, int, const char*> cases[] = {
      {1000.0, 3, "1000"},    {999.9, 2, "999.9"},    {99.96, 2, "100"},    {-2e4, 3, "-20000"},
      {20'000.0, 4, "20000"}, {0.01234, 3, "0.0123"}, {2.0, 3, "2"},        {123.456, 2, "123"},
      {1e18, 3, "1e+18"},     {-1e300, 3, "-1e+300"}, {INFINITY, 3, "inf"}, {0.0, 3, "0"}};
  for (const auto& [value, digits, text] : cases) EXPECT_EQ(readable(value, digits), text);
}

TEST(WithInterval, OfOneRunHasNone) {
  EXPECT_EQ(with_interval({0.977, std::nan(""), std::nan("")}), "0.977");
}

struct Place {
  std::string scene;
  double noise = 0.0;
};

struct Row {
  Place place;
  Interval accuracy;
  double delay = 0.0;
  int runs = 0;
  bool is_best = false;
};

Columns<Row> columns() {
  return Columns<Row>()
      .part(&Row::place, Columns<Place>()
                             .text("scenario", &Place::scene)
                             .as("scene")
                             .level("noise", &Place::noise))
      .interval("accuracy", &Row::accuracy)
      .metric("delay_ms", [](const Row& row) { return 1e3 * row.delay; })
      .runs("runs", &Row::runs)
      .flag("is_best", &Row::is_best)
      .is(ColumnRole::note);
}

TEST(Columns, WriteOneLinePerRow) {
  const std::vector<Row> rows = {{{"stairs", 0.5}, {0.9, 0.8, 1.0}, 0.02, 4, true},
                                 {{"a,b", 1.0}, {NAN, NAN, NAN}, 0.0, 0, false}};
  EXPECT_EQ(to_csv(columns().table(rows)),
            "scenario,noise,accuracy,accuracy_low,accuracy_high,delay_ms,runs,is_best\n"
            "stairs,0.5,0.900000,0.800000,1.000000,20.000000,4,1\n"
            "\"a,b\",1,nan,nan,nan,0.000000,0,0\n");
}

TEST(Columns, KeepTheUnitOfBoundsLast) {
  const auto latency = Columns<Row>().interval("latency_ms", &Row::accuracy);
  EXPECT_THAT(texts_of(latency.table(std::vector<Row>())).header,
              ElementsAre("latency_ms", "latency_low_ms", "latency_high_ms"));
}

struct Score {
  std::string engine;
  std::string estimator;
  int value = 0;
};

const std::vector<Score> scores = {
    {"mujoco", "paper", 1}, {"bullet", "paper", 2}, {"mujoco", "bayes", 3}, {"mujoco", "paper", 4}};

std::string text_of(const Score& score) { return std::to_string(score.value); }

TEST(Unique, KeepsTheOrderOfFirstAppearance) {
  EXPECT_THAT(unique(scores, &Score::engine), ElementsAre("mujoco", "bullet"));
  EXPECT_THAT(unique(scores, [](const Score& score) { return score.value % 2; }),
              ElementsAre(1, 0));
  EXPECT_TRUE(unique(std::vector<Score>(), &Score::engine).empty());
}

TEST(Where, KeepsTheRowsThatMeetThePredicate) {
  const auto found = where(scores, [](const Score& score) { return score.engine == "mujoco"; });
  EXPECT_THAT(unique(found, &Score::value), ElementsAre(1, 3, 4));
}

TEST(GroupBy, CollectsInterleavedRowsInOrder) {
  const auto groups = group_by(scores, &Score::estimator);
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[0].key, "paper");
  EXPECT_THAT(unique(groups[0].rows, &Score::value), ElementsAre(1, 2, 4));
  EXPECT_EQ(groups[1].key, "bayes");
  EXPECT_THAT(unique(groups[1].rows, &Score::value), ElementsAre(3));
}

TEST(Pivot, PutsADashWhereNoRowIs) {
  const std::vector<Score> without_repetition(scores.begin(), scores.begin() + 3);
  const TextTable table = pivot(without_repetition, &Score::estimator, &Score::engine, text_of);
  EXPECT_THAT(table.header, ElementsAre("", "mujoco", "bullet"));
  EXPECT_THAT(table.rows,
              ElementsAre(ElementsAre("paper", "1", "2"), ElementsAre("bayes", "3", "–")));
}

TEST(WrappedText, CountsLettersNotBytes) {
  EXPECT_EQ(wrapped("aaa bbb ccc", 7), "aaa bbb\nccc");
  EXPECT_EQ(wrapped("äää äää ccc", 7), "äää äää\nccc");
  EXPECT_EQ(wrapped("", 7), "");
  EXPECT_EQ(wrapped("averylongword b", 4), "averylongword\nb");
}

}  // namespace
}  // namespace touchdown
