#include "render/gnuplot/facets.hpp"

#include <algorithm>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "render/gnuplot/process.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::render {
namespace {

using experiments::AxisScale;
using experiments::FigureSpec;
using experiments::MarkShape;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

/// How often a pattern occurs.
std::ptrdiff_t count(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern);
  return std::distance(std::sregex_iterator(text.begin(), text.end(), regex), {});
}

/// The lines of a script that define functions with names that begin so.
std::vector<std::string> lines_with(const std::string& script, const std::string& name) {
  std::vector<std::string> lines;
  std::istringstream stream(script);
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with(name)) lines.push_back(line + '\n');
  }
  return lines;
}

/// Two engines, two sources, two heights, with an interval; interleaved and not in order of x.
constexpr const char* survival =
    "engine,source,height,share,low,high,speed\n"
    "m,truth,0.7,0.9,0.8,1,0.2\n"
    "m,loads,0.7,0.5,0.4,0.6,nan\n"
    "m,truth,0.5,1,0.9,1,0.1\n"
    "m,loads,0.5,0.7,0.6,0.8,nan\n"
    "b,truth,0.5,0.8,0.7,0.9,0.3\n"
    "b,loads,0.5,0.6,0.5,0.7,0.4\n"
    "b,loads,0.7,nan,nan,nan,0.5\n"
    "b,loads,0.9,0.2,0.1,0.3,0.6\n"
    "b,other,0.9,0.2,0.1,0.3,0.6\n";

FigureSpec survival_spec() {
  FigureSpec spec;
  spec.panels = {{"engine"}, {{{"b"}, "Bullet"}, {{"m"}, "MuJoCo"}}};
  spec.series = {{"source"}, {{{"truth"}, "Truth"}, {{"loads"}, "Load filter"}}};
  spec.x = {.column = "height", .title = "height of a step", .unit = "m"};
  spec.measures = {{.column = "share", .title = "share", .low = "low", .high = "high"}};
  spec.title = "Survival";
  spec.caption = "Eight runs.";
  spec.alt = "The share falls.";
  return spec;
}

class Facets : public ::testing::Test {
 protected:
  /// Draws the figure and returns its script.
  std::string script(const FigureSpec& spec, const std::string& csv) {
    EXPECT_TRUE(draw_facets(spec, table_of(from_csv(csv)), folder_ / "figure"));
    for (const char* kind : {"figure.png", "figure.svg", "figure.pdf"}) {
      EXPECT_TRUE(std::filesystem::exists(folder_ / kind)) << kind;
    }
    return read_file(folder_ / "figure.gp");
  }
  TextTable data() const { return from_csv(read_file(folder_ / "figure.dat")); }

  /// The values of one column of the data file.
  std::vector<std::string> column(const std::string& name) const {
    const TextTable table = data();
    std::vector<std::string> values;
    for (const auto& row : table.rows) values.push_back(cell(table, row, name));
    return values;
  }

  const ScratchFolder folder_;
};

TEST_F(Facets, DrawAPanelPerGroupAndACurvePerSeries) {
  const std::string text = script(survival_spec(), survival);
  EXPECT_EQ(count(text, "\nplot "), 2);
  EXPECT_EQ(count(text, "with yerrorlines"), 4);
  EXPECT_EQ(count(text, "keyentry"), 2);  // one legend
  EXPECT_EQ(count(text, "set title 'Bullet'"), 1);
  EXPECT_EQ(count(text, "set title 'MuJoCo'"), 1);
  EXPECT_LT(text.find("set title 'Bullet'"), text.find("set title 'MuJoCo'"));
  EXPECT_THAT(text, HasSubstr("set xlabel 'height of a step (m)'"));
  EXPECT_THAT(text, HasSubstr("strcol('source') eq 'loads'"));
}

TEST_F(Facets, HaveAPanelPerMeasureAndGroup) {
  FigureSpec spec = survival_spec();
  spec.measures.push_back({.column = "speed", .title = "speed", .unit = "m/s"});
  const std::string text = script(spec, survival);
  EXPECT_EQ(count(text, "\nplot "), 4);
  EXPECT_THAT(text, HasSubstr("set ylabel 'speed (m/s)'"));
}

TEST_F(Facets, DrawStepsForValuesThatHoldUntilTheNext) {
  FigureSpec spec = survival_spec();
  spec.measures = {{.column = "share", .title = "share"}};
  spec.marks = {{MarkShape::step}};
  const std::string text = script(spec, survival);
  EXPECT_EQ(count(text, "with steps lt [1-7] lw [0-9.]+ notitle"), 2);  // the truth has its own
  EXPECT_EQ(count(text, "with steps lc rgb"), 2);
  EXPECT_EQ(count(text, "keyentry with lines"), 2);
}

TEST_F(Facets, StateTheirTextsInTheScript) {
  const std::string text = script(survival_spec(), survival);
  EXPECT_THAT(text, ::testing::StartsWith("# Draws figure.png"));
  EXPECT_EQ(figure_text(text).title, "Survival");
  EXPECT_EQ(figure_text(text).caption, "Eight runs.");
  EXPECT_EQ(figure_text(text).alt, "The share falls.");
  EXPECT_THAT(text, HasSubstr("'figure.dat'"));
}

TEST_F(Facets, KeepTheDrawnRowsOfTheTableBesideThemByCurveAndX) {
  script(survival_spec(), survival);
  EXPECT_THAT(data().header,
              ElementsAre("engine", "source", "height", "share", "low", "high", "speed"));
  EXPECT_THAT(column("engine"), ElementsAre("b", "b", "b", "b", "m", "m", "m", "m"));
  EXPECT_THAT(column("source"),
              ElementsAre("truth", "loads", "loads", "loads", "truth", "truth", "loads", "loads"));
  EXPECT_THAT(column("height"),
              ElementsAre("0.5", "0.5", "0.7", "0.9", "0.5", "0.7", "0.5", "0.7"));
  EXPECT_EQ(column("share")[2], "nan");  // a gap in the curve
}

TEST_F(Facets, DrawOnlyTheRowsThatPassTheFilter) {
  FigureSpec spec = survival_spec();
  spec.where = {{"engine", "m"}};
  const std::string text = script(spec, survival);
  EXPECT_EQ(count(text, "\nplot "), 1);
  EXPECT_THAT(column("engine"), ElementsAre("m", "m", "m", "m"));
}

TEST_F(Facets, LeaveOutMeasuresWithoutValues) {
  FigureSpec spec = survival_spec();
  spec.where = {{"source", "loads"}, {"engine", "m"}};
  spec.measures.push_back({.column = "speed", .title = "speed"});
  EXPECT_THAT(script(spec, survival), Not(HasSubstr("speed')")));
}

TEST_F(Facets, WithoutValuesAreNotDrawn) {
  FigureSpec spec = survival_spec();
  spec.where = {{"engine", "none"}};
  EXPECT_FALSE(draw_facets(spec, table_of(from_csv(survival)), folder_ / "figure"));
  EXPECT_FALSE(draw_facets(survival_spec(), {}, folder_ / "figure"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "figure.gp"));
}

TEST_F(Facets, DrawASinglePoint) {
  FigureSpec spec;
  spec.x = {.column = "x", .title = "x"};
  spec.measures = {{.column = "y", .title = "y"}};
  const std::string text = script(spec, "x,y\n3,5\n");
  EXPECT_THAT(text, HasSubstr("set xrange [1.5:4.5]"));
  EXPECT_EQ(count(text, "\nplot "), 1);
  EXPECT_THAT(text, HasSubstr("unset key"));
}

TEST_F(Facets, LeaveOutValuesThatALogarithmicAxisCannotShow) {
  FigureSpec spec;
  spec.x = {.column = "x", .title = "x"};
  spec.measures = {{.column = "y", .title = "y", .scale = AxisScale::log}};
  EXPECT_THAT(script(spec, "x,y\n1,0\n2,4\n3,8\n"), HasSubstr("set yrange [3.2:10]"));
}

TEST_F(Facets, NumberALogarithmicAxisThatReachesNoDecade) {
  for (const auto& [low, high] : {std::pair{0.24, 0.48},
                                  {0.3, 0.35},
                                  {1.3, 1.4},
                                  {4.0, 7.0},
                                  {88.0, 110.0},
                                  {0.003, 0.0041},
                                  {0.64, 5.0},
                                  {2.0, 90.0}}) {
    FigureSpec spec;
    spec.x = {.column = "x", .title = "x"};
    spec.measures = {{.column = "y", .title = "y", .scale = AxisScale::log}};
    const std::string text = script(spec, fmt::format("x,y\n1,{}\n2,{}\n", low, high));
    const std::string tics = lines_with(text, "set ytics (").at(0);
    std::istringstream numbers(tics.substr(tics.find('(') + 1));
    int inside = 0;
    for (std::string number; std::getline(numbers, number, ',');) {
      const double tic = std::stod(number);
      if (tic >= 0.8 * low && tic <= 1.25 * high) ++inside;
    }
    EXPECT_GE(inside, 1) << tics;
    EXPECT_LE(inside, 6) << tics;
  }
}

TEST_F(Facets, DrawNamesThatGnuplotWouldInterpret) {
  const std::vector<std::string> names = {"a \"quoted\", 'name'", "$x @y `z`", "-dash",    "#hash",
                                          "back\\nslash",         "100 %",     "line\nend"};
  TextTable table{{"name", "x", "y"}, {}};
  FigureSpec spec;
  spec.x = {.column = "x", .title = "x"};
  spec.measures = {{.column = "y", .title = "y"}};
  spec.series.columns = {"name"};
  for (const std::string& name : names) {
    spec.series.groups.push_back({{name}, name});
    for (const char* x : {"1", "2"}) table.rows.push_back({name, x, "1"});
  }
  EXPECT_TRUE(draw_facets(spec, table_of(table), folder_ / "figure"));
  const std::string text = read_file(folder_ / "figure.gp");
  EXPECT_EQ(count(text, "with linespoints lt [1-7] lw [0-9.]+ notitle"), 7);
  // The script's own selections, applied by gnuplot to the figure's data.
  std::string check = "set datafile separator comma\nset datafile columnheaders\n";
  for (const std::string& line : lines_with(text, "series")) check += line;
  for (std::size_t i = 1; i <= names.size(); ++i) {
    check += fmt::format(
        "set table '{0}.txt'\n"
        "plot 'figure.dat' using (series{0}(column('x'))):(column('y')) with table\n"
        "unset table\n",
        i);
  }
  folder_.write("check.gp", check);
  EXPECT_EQ(gnuplot_complaint(folder_.path(), "check.gp"), "");
  for (std::size_t i = 1; i <= names.size(); ++i) {
    const std::string rows = read_file(folder_ / fmt::format("{}.txt", i));
    EXPECT_EQ(count(rows, "[12]\\s+1\\s*\n"), 2) << names[i - 1] << rows;
  }
  const std::string data = read_file(folder_ / "figure.dat");
  EXPECT_THAT(data, Not(HasSubstr("\"")));
}

TEST_F(Facets, ListRowsBesideHorizontalMeasures) {
  FigureSpec spec = survival_spec();
  spec.where = {{"height", "0.5"}};
  spec.series = survival_spec().panels;
  spec.panels = {};
  spec.rows = survival_spec().series;
  const std::string text = script(spec, survival);
  EXPECT_EQ(count(text, "\nplot "), 1);
  EXPECT_EQ(count(text, "with xerrorbars"), 2);
  EXPECT_THAT(text, HasSubstr("'Truth' 1, 'Load filter' 0"));  // the first above
  EXPECT_THAT(text, HasSubstr("set xlabel 'share'"));
}

TEST_F(Facets, SpaceOrdinalValuesEquallyInEachPanel) {
  FigureSpec spec = survival_spec();
  spec.x.scale = AxisScale::ordinal;
  const std::string text = script(spec, survival);
  EXPECT_THAT(text, HasSubstr("set xtics ('0.5' 0, '0.7' 1, '0.9' 2)"));  // Bullet
  EXPECT_THAT(text, HasSubstr("set xtics ('0.5' 0, '0.7' 1)"));           // MuJoCo
}

/// A Pareto front and the estimator's own point.
TEST_F(Facets, DrawMarksByTheirConditionsAndTransformedValues) {
  FigureSpec spec;
  spec.series = {{"estimator"}, {{{"robust"}, "Robust"}, {{"loads"}, "Load filter"}}};
  spec.colour_order = {"paper", "robust", "loads"};
  spec.x = {.column = "switches", .title = "switches", .scale = AxisScale::log, .floor = 0.3};
  spec.measures = {{.column = "accuracy",
                    .title = "error",
                    .unit = "%",
                    .scale = AxisScale::log,
                    .factor = -100.0,
                    .offset = 100.0}};
  spec.marks = {{MarkShape::curve, {{"on_front", "1"}}}, {MarkShape::ring, {{"leave", ""}}}};
  const std::string text = script(spec,
                                  "estimator,leave,accuracy,switches,on_front\n"
                                  "robust,,0.97,12,0\n"
                                  "robust,0.5,0.98,7,1\n"
                                  "robust,0.4,0.96,9,0\n"
                                  "robust,0.1,0.95,0,1\n"
                                  "loads,,0.99,2,0\n"
                                  "loads,0.5,0.992,3,1\n");
  EXPECT_EQ(count(text, "with linespoints lt 2 lw [0-9.]+ notitle"), 1);
  EXPECT_EQ(count(text, "with points lt 2 pt 6 ps 1.6 lw 2 notitle"), 1);
  EXPECT_EQ(count(text, "with linespoints lt 3 lw [0-9.]+ notitle"), 1);
  EXPECT_EQ(count(text, "with points lt 3 pt 6 ps 1.6 lw 2 notitle"), 1);
  EXPECT_THAT(text, HasSubstr("at_least(column('switches'), 0.3)"));
  EXPECT_THAT(text, HasSubstr("100+-100*column('accuracy')"));
  // From 0.3 to 12 extra switches and from 0.8 to 5 %, with a margin.
  EXPECT_THAT(text, HasSubstr("set xrange [0.24:15]"));
  EXPECT_THAT(text, HasSubstr("set yrange [0.64:6.25]"));
  EXPECT_THAT(column("switches"), ElementsAre("0", "7", "12", "3", "2"));  // not the dominated 9
}

}  // namespace
}  // namespace touchdown::render
