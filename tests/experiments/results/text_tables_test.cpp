#include "experiments/results/text_tables.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace touchdown::experiments {
namespace {

using ::testing::HasSubstr;

const CaptionedTable sample = {
    "Above 1 N > 0, 95 %", "sample", {{"name", "how", "x_y"}, {{"a & b", "c", "1 ± 2"}}}};

TEST(Markdown, HasARuleUnderItsHeader) {
  EXPECT_EQ(to_markdown(sample),
            "Above 1 N > 0, 95 %\n\n| name | how | x_y |\n|---|---|---:|\n| a & b | c | 1 ± 2 |\n");
}

TEST(Markdown, HasNoRawHtmlAndNoCellThatEndsEarly) {
  const CaptionedTable harmful = {
      "<img src=x onerror=alert(1)>",
      "sample",
      {{"<b>name", "a|b"}, {{"<script>", "p < 0.05"}, {"</td>", "x <!-- y"}, {"a\nb", "<3"}}}};
  EXPECT_EQ(to_markdown(harmful),
            "&lt;img src=x onerror=alert(1)>\n\n| &lt;b>name | a\\|b |\n|---|---|\n"
            "| &lt;script> | p < 0.05 |\n| &lt;/td> | x &lt;!-- y |\n| a b | <3 |\n");
}

TEST(Latex, EscapesMarkupAndUsesBooktabs) {
  const std::string latex = to_latex(sample);
  EXPECT_THAT(latex,
              HasSubstr("name & how & x\\_y \\\\\n\\midrule\na \\& b & c & 1 $\\pm$ 2 \\\\"));
  EXPECT_THAT(latex, HasSubstr("\\begin{tabular}{llr}"));
  EXPECT_THAT(latex, ::testing::StartsWith("% Above 1 N > 0, 95 %\n\\begin{tabular}"));
  EXPECT_THAT(latex, ::testing::EndsWith("\\bottomrule\n\\end{tabular}\n"));
}

}  // namespace
}  // namespace touchdown::experiments
