#include <set>
#include <string>
#include <tuple>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "experiments/figures/figure_spec.hpp"
#include "experiments/results/captions.hpp"
#include "render/figures/figures.hpp"
#include "render/film/strip.hpp"
#include "render/gnuplot/facets.hpp"
#include "render/palette.hpp"
#include "tests/render/staged_run.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::render {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

const std::vector<std::string> estimators = {"robust", "paper", "load_filter"};

/// A figure with a curve for each of these estimators of an experiment that has all.
std::string script_of(const std::vector<std::string>& shown, const ScratchFolder& folder,
                      const std::string& name) {
  std::string text = "estimator,switches,error,error_low,error_high\n";
  for (const std::string& estimator : shown) {
    for (const char* at : {"1", "2"}) text += estimator + "," + at + ",0.75,0.35,0.97\n";
  }
  const Table table = table_of(from_csv(text));
  experiments::FigureSpec spec{.name = name, .table = name + ".csv"};
  spec.series =
      experiments::groups_in(table, "estimator", experiments::titles_in(experiments::Experiment{}));
  spec.colour_order = estimators;
  spec.x = {.column = "switches", .title = "switches"};
  spec.measures = {experiments::axis_with_interval("error", "error")};
  draw_facets(spec, table, folder / name);
  return read_file(folder / (name + ".gp"));
}

TEST(EstimatorColours, AreTheSameInFiguresOfDifferentSubsets) {
  const ScratchFolder folder;
  // In the experiment, the load filter is the third estimator.
  EXPECT_THAT(script_of(estimators, folder, "all"),
              ContainsRegex("lt 3 lw [0-9.]+ title 'Load filter'"));
  EXPECT_THAT(script_of({"load_filter", "robust"}, folder, "two"),
              ContainsRegex("lt 3 lw [0-9.]+ title 'Load filter'"));
  EXPECT_THAT(script_of({"load_filter"}, folder, "alone"),
              AllOf(HasSubstr("with yerrorlines lt 3 "), Not(HasSubstr("with yerrorlines lt 1 "))));
}

TEST(EstimatorColours, AreThoseOfFilms) {
  const models::RobotModel robot = models::compile_robot_model(upkie_mjcf, staged_terrain());
  const logs::Recording run = staged_run(0.5);
  const std::vector<BeliefTrack> beliefs = {
      staged_beliefs(run, "Load filter", line_type_of(estimators, "load_filter"))};
  const std::vector<StripRow> rows = strip_rows({{robot, run, beliefs}}, {});
  ASSERT_EQ(rows.front().curves.size(), models::wheel_count);
  for (const StripCurve& curve : rows.front().curves) {
    EXPECT_EQ(curve.colour, rgb(line_colours[2]));
  }
}

TEST(FilmedRun, ShowsAllTorquesOverTrueContactWithoutBeliefs) {
  const models::RobotModel robot = models::compile_robot_model(upkie_mjcf, staged_terrain());
  for (const auto& [servo, peak, range, title] :
       std::vector<std::tuple<models::Servo, double, float, std::string>>{
           {models::Servo::left_knee, 8.0, 8.0F, "torque (N·m)"},
           {models::Servo::left_wheel, -5.0, 5.0F, "torque (N·m)"},
           {models::Servo::left_knee, 1e4, 10.0F, "torque (N·m), peaks 1e+04"},
           {models::Servo::right_knee, 8.0, 1.0F, "torque (N·m)"}}) {
    logs::Recording run = staged_run(0.5);
    for (models::Observation& row : run.observation) {
      for (models::ServoReading& one : row.servo) one.torque = 1.0;
    }
    run.observation[200].servo[models::index(servo)].torque = peak;
    const std::vector<BeliefTrack> none;
    const std::vector<StripRow> rows = strip_rows({{robot, run, none}}, {});
    ASSERT_EQ(rows.size(), 1U);
    EXPECT_EQ(rows[0].title, title);
    EXPECT_EQ(rows[0].high, range);
    EXPECT_EQ(rows[0].wheels_in_contact.size(), run.steps());
  }
}

TEST(EstimatorColours, DifferUpToTheNumberOfLineTypes) {
  std::vector<std::string> many;
  for (std::size_t i = 0; i < line_colours.size(); ++i) many.push_back(std::to_string(i));
  std::set<unsigned> colours;
  for (const std::string& name : many) colours.insert(line_colour(line_type_of(many, name)));
  EXPECT_EQ(colours.size(), line_colours.size());
}

}  // namespace
}  // namespace touchdown::render
