#include "experiments/table.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/paper_tables.hpp"

namespace touchdown {
namespace {

using ::testing::HasSubstr;

TEST(Csv, QuotesWhatWouldBreakALine) {
  EXPECT_EQ(to_csv({{"a", "b"}, {{"x,y", "say \"hi\""}, {"1", "2"}}}),
            "a,b\n\"x,y\",\"say \"\"hi\"\"\"\n1,2\n");
}

TEST(TextTable, AlignsByCharactersNotBytes) {
  EXPECT_EQ(to_text({{"name", "v"}, {{"m/s²", "10"}, {"a", "±1"}}}),
            "  name    v\n  ────   ──\n  m/s²   10\n  a      ±1\n");
  EXPECT_EQ(to_text({{}, {{"a", "b"}, {"cc", "d"}}}, 2), "  a    b\n  cc   d\n");
}

TEST(Numbers, ReadBackExactlyAndSayWhatIsUndefined) {
  EXPECT_EQ(exact(0.25), "0.25");
  EXPECT_EQ(std::stod(exact(0.1 + 0.2)), 0.1 + 0.2);
  EXPECT_EQ(metric(2.0 / 3.0), "0.666667");
  EXPECT_EQ(metric(NAN), "nan");
  EXPECT_EQ(with_interval({0.5, 0.25, 0.75}, 2), "0.50 [0.25, 0.75]");
  EXPECT_EQ(with_interval({NAN, NAN, NAN}), "–");
}

const CaptionedTable sample = {
    "Above 1 N > 0, 95 %", "sample", {{"who", "how", "x_y"}, {{"a & b", "c", "1 ± 2"}}}};

TEST(Markdown, HasARuleUnderItsHeader) {
  EXPECT_EQ(to_markdown(sample),
            "Above 1 N > 0, 95 %\n\n| who | how | x_y |\n|---|---|---:|\n| a & b | c | 1 ± 2 |\n");
}

TEST(Latex, EscapesMarkupAndUsesBooktabs) {
  const std::string latex = to_latex(sample);
  EXPECT_THAT(latex, HasSubstr("who & how & x\\_y \\\\\n\\midrule\na \\& b & c & 1 $\\pm$ 2 \\\\"));
  EXPECT_THAT(latex, HasSubstr("\\begin{tabular}{llr}"));
  EXPECT_THAT(latex, HasSubstr("\\caption{Above 1 N $>$ 0, 95 \\%}"));
}

}  // namespace
}  // namespace touchdown
