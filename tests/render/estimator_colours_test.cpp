#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "experiments/studies/closed_loop/figures.hpp"
#include "experiments/studies/operating_points/figures.hpp"
#include "render/figures/figures.hpp"
#include "render/gnuplot/facets.hpp"
#include "render/film/strip.hpp"
#include "render/palette.hpp"
#include "tests/render/staged_run.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::render {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const std::vector<std::string> estimators = {"robust", "paper", "phase"};

experiments::Experiment experiment() {
  experiments::Experiment experiment;
  experiment.estimators = estimators;
  return experiment;
}

/// Operating points of these estimators, each with its own thresholds alone.
std::string operating_points_script(const std::vector<std::string>& shown,
                                    const ScratchFolder& folder, const std::string& name) {
  std::string text =
      "torque_noise_nm,accelerometer_noise_mps2,estimator,leave_below,return_above,"
      "balanced_accuracy,extra_switches_per_minute,on_front\n";
  for (const std::string& estimator : shown) text += "0,0," + estimator + ",,,0.97,12,1\n";
  const Table table = from_csv(text);
  draw_facets(operating_points_figure(table, experiment()), table, folder / name);
  return read_file(folder / (name + ".gp"));
}

std::string survival_script(const std::vector<std::string>& shown, const ScratchFolder& folder) {
  std::string text =
      "simulator,scenario,policy,contact,runs,finished,finished_low,finished_high,varied,value,"
      "sensors,landing_speed_rms_mps\n";
  for (const std::string& contact : shown) {
    for (const char* at : {"0.5", "0.7"}) {
      text +=
          "mujoco,stairs,soft_landing," + contact + ",8,0.75,0.35,0.97,rise," + at + ",upkie,nan\n";
    }
  }
  const Table table = from_csv(text);
  draw_facets(survival_figures(table, experiment()).front(), table, folder / "survival");
  return read_file(folder / "survival.gp");
}

TEST(EstimatorColours, AreTheSameInFiguresOfDifferentSubsets) {
  const ScratchFolder folder;
  // In the experiment, the phase filter is the third estimator.
  const std::string curve = "lt 3 title 'Phase filter'";
  const std::string ring = "lt 3 pt 6 ps 1.6 lw 2";
  EXPECT_THAT(operating_points_script(estimators, folder, "all"), HasSubstr(curve));
  EXPECT_THAT(operating_points_script({"phase"}, folder, "alone"),
              AllOf(HasSubstr(ring), Not(HasSubstr("lt 1 pt 6"))));
  EXPECT_THAT(operating_points_script({"phase", "robust"}, folder, "two"), HasSubstr(curve));
  const std::string survival = survival_script({"truth", "phase"}, folder);
  EXPECT_THAT(survival, HasSubstr("with yerrorlines lt 3 "));
  EXPECT_THAT(survival, Not(HasSubstr("with yerrorlines lt 1 ")));
}

TEST(EstimatorColours, AreThoseOfTheScoresAndFilms) {
  const ScratchFolder folder;
  ScoreRow row;
  row.name = "Phase filter";
  row.line_type = line_type_of(estimators, "phase");
  for (int i = 0; i < 10; ++i) row.calibration.add(true, 0.9);
  row.contact_frequency.resize(scoring::Calibration::bins);
  const ScoreFigure figure{"Reliability", {{"no noise", {row}}}, ""};
  draw_reliability_figure(figure, folder / "reliability");
  EXPECT_THAT(read_file(folder / "reliability.gp"),
              HasSubstr("with linespoints lt 3 title 'Phase filter'"));

  const models::RobotModel robot = models::compile_robot_model(upkie_mjcf, staged_terrain());
  const recordings::Recording run = staged_run(0.5);
  const std::vector<BeliefTrack> beliefs = {
      staged_beliefs(run, "Phase filter", line_type_of(estimators, "phase"))};
  const std::vector<StripRow> rows = strip_rows({{robot, run, beliefs}}, {});
  ASSERT_EQ(rows.front().curves.size(), models::wheel_count);
  for (const StripCurve& curve : rows.front().curves) {
    EXPECT_EQ(curve.colour, rgb(line_colours[2]));
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
