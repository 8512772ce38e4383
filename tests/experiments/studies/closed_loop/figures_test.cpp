#include "experiments/studies/closed_loop/figures.hpp"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace touchdown::experiments {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

const char* const header =
    "simulator,scenario,policy,contact,rise_m,runs,finished,finished_low,finished_high,varied,key,"
    "value,delay_ms,torque_noise_nm,sensors,landing_speed_rms_mps,false_takeoffs_per_minute\n";

std::string row(const std::string& scene, const std::string& contact, const std::string& varied,
                const std::string& value, const std::string& speed) {
  return "mujoco," + scene + ",soft_landing," + contact + ",nan,8,0.75,0.35,0.97," + varied +
         ",k," + value + ",20,1,upkie," + speed + ",0\n";
}

std::vector<FigureSpec> figures_of(const std::string& rows) {
  Experiment experiment;
  experiment.estimators = {"robust", "phase"};
  return survival_figures(from_csv(header + rows), experiment);
}

TEST(SurvivalFigure, HasACurvePerContactSourceOverTheVariedQuantity) {
  const std::vector<FigureSpec> figures = figures_of(
      row("stairs", "truth", "rise", "0.5", "0.2") + row("stairs", "truth", "rise", "0.7", "0.3") +
      row("stairs", "phase", "rise", "0.5", "0.2") + row("stairs", "phase", "rise", "0.7", "nan"));
  ASSERT_EQ(figures.size(), 1U);
  const FigureSpec& figure = figures.front();
  EXPECT_EQ(figure.name, "survival_stairs_soft_landing_rise");
  ASSERT_EQ(figure.series.groups.size(), 2U);
  EXPECT_EQ(figure.series.groups[0].title, "Truth (oracle)");
  EXPECT_EQ(figure.series.groups[1].title, "Phase filter");
  EXPECT_EQ(figure.x.title, "height of a step");
  EXPECT_EQ(figure.x.unit, "m");
  EXPECT_THAT(figure.caption, HasSubstr("8 runs per point"));
  EXPECT_THAT(figure.alt, HasSubstr("MuJoCo, Truth (oracle): 0.75 at 0.5 m"));
}

TEST(SurvivalFigure, WithoutAVariedQuantityHasARowPerContactSource) {
  const std::vector<FigureSpec> figures = figures_of(row("put_down", "truth", "", "nan", "0.05") +
                                                     row("put_down", "always", "", "nan", "1.6") +
                                                     row("roam", "truth", "", "nan", "nan"));
  ASSERT_EQ(figures.size(), 2U);
  EXPECT_EQ(figures[0].name, "survival_put_down_soft_landing");
  ASSERT_EQ(figures[0].rows.groups.size(), 2U);
  EXPECT_EQ(figures[0].rows.groups[1].title, "Always contact");
  EXPECT_EQ(figures[1].name, "survival_roam_soft_landing");
  EXPECT_EQ(figures[1].rows.groups.size(), 1U);
}

TEST(SurvivalFigure, DelayIsInMilliseconds) {
  const std::vector<FigureSpec> figures =
      figures_of(row("stairs", "truth", "delay", "nan", "0.05"));
  ASSERT_EQ(figures.size(), 1U);
  EXPECT_EQ(figures.front().x.column, "delay_ms");
  EXPECT_EQ(figures.front().x.unit, "ms");
}

TEST(SurvivalFigure, WithoutRowsThereIsNone) { EXPECT_THAT(figures_of(""), IsEmpty()); }

}  // namespace
}  // namespace touchdown::experiments
