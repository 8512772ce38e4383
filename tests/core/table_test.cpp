#include "core/table.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace touchdown {
namespace {

TEST(Csv, QuotesWhatWouldBreakALine) {
  EXPECT_EQ(to_csv({{"a", "b"}, {{"x,y", "a \"b\""}, {"1", "2"}}}),
            "a,b\n\"x,y\",\"a \"\"b\"\"\"\n1,2\n");
}

TEST(Csv, IsReadAsItWasWritten) {
  const Table table{{"a", "b,\"c\""}, {{"1", "two\nlines"}, {"", "x"}}};
  const Table read = from_csv(to_csv(table));
  EXPECT_EQ(read.header, table.header);
  EXPECT_EQ(read.rows, table.rows);
  EXPECT_TRUE(from_csv("").header.empty());
  EXPECT_EQ(from_csv("x,y\n1.5\n").rows, (std::vector<std::vector<std::string>>{{"1.5", ""}}));
}

TEST(TextTable, AlignsByCharactersNotBytes) {
  EXPECT_EQ(to_text({{"name", "v"}, {{"m/s²", "10"}, {"a", "±1"}}}),
            "  name    v\n  ────   ──\n  m/s²   10\n  a      ±1\n");
  EXPECT_EQ(to_text({{}, {{"a", "b"}, {"cc", "d"}}}, 2), "  a    b\n  cc   d\n");
}

TEST(Numbers, ReadBackExactlyAndMarkUndefinedValues) {
  EXPECT_EQ(exact(0.25), "0.25");
  EXPECT_EQ(std::stod(exact(0.1 + 0.2)), 0.1 + 0.2);
  EXPECT_EQ(metric(2.0 / 3.0), "0.666667");
  EXPECT_EQ(metric(NAN), "nan");
  EXPECT_EQ(with_interval({0.5, 0.25, 0.75}, 2), "0.50 [0.25, 0.75]");
  EXPECT_EQ(with_interval({NAN, NAN, NAN}), "–");
}

TEST(IntervalColumns, KeepTheUnitLastAndHoldMetrics) {
  const Table table{header_with_intervals({"estimator"}, {"success", "latency_ms"}, {"steps"}),
                    {row_with_intervals({"a"}, {{0.5, 0.25, 0.75}, {NAN, NAN, NAN}}, {"7"})}};
  EXPECT_EQ(
      to_csv(table),
      "estimator,success,success_low,success_high,latency_ms,latency_low_ms,latency_high_ms,steps\n"
      "a,0.500000,0.250000,0.750000,nan,nan,nan,7\n");
}

TEST(Csv, MarksTextsThatSpreadsheetsWouldCompute) {
  const std::vector<std::string> harmful = {
      "=1+1", "+cmd|' /C calc'!A0", "-2+3", "@SUM(A1)", "\t=1", "\r=1", "'=1", "=\"a\",\"b\""};
  for (const std::string& cell : harmful) {
    const std::string csv = to_csv({{"name"}, {{cell}}});
    const std::string second = csv.substr(csv.find('\n') + 1);
    EXPECT_TRUE(second.starts_with('\'') || second.starts_with("\"'")) << csv;
    EXPECT_EQ(from_csv(csv).rows.at(0).at(0), cell) << csv;
  }
  // Numbers, dashes and other texts are as they are.
  for (const std::string cell : {"-1.5", "+2", "-1e-9", "-inf", "nan", "-", "–", "a=b", "'tis"}) {
    EXPECT_EQ(to_csv({{"x"}, {{cell}}}), "x\n" + cell + "\n");
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

TEST(WithInterval, OfOneRunHasNone) {
  EXPECT_EQ(with_interval({0.977, std::nan(""), std::nan("")}), "0.977");
}

}  // namespace
}  // namespace touchdown
