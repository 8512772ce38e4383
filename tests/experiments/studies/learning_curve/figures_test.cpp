#include "experiments/studies/learning_curve/figures.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/studies/learning_curve/config.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::HasSubstr;

TEST(LearningCurveFigure, HasAPanelPerEngineAndNoiseSettingAndACurvePerEstimator) {
  const Table table = from_csv(
      "simulator,torque_noise_nm,accelerometer_noise_mps2,estimator,size,labelled_s,"
      "balanced_accuracy,balanced_accuracy_low,balanced_accuracy_high\n"
      "mujoco,0,0,robust,1,1.9,0.9,0.8,1\n"
      "mujoco,1,5,robust,1,1.9,0.7,0.6,0.8\n"
      "mujoco,0,0,phase,4,7.6,0.95,0.9,1\n"
      "bullet,0,0,robust,1,1.8,0.9,0.8,1\n");
  Experiment experiment;
  experiment.estimators = {"free_fall", "robust", "phase"};
  experiment.studies.emplace<LearningCurveConfig>({.sizes = {1, 4}, .draws = 3});
  const FigureSpec figure = learning_curve_figure(table, experiment);
  ASSERT_EQ(figure.panels.groups.size(), 3U);
  EXPECT_EQ(figure.panels.groups[1].title, "MuJoCo, 1 N·m, 5 m/s²");
  ASSERT_EQ(figure.series.groups.size(), 2U);
  EXPECT_EQ(figure.series.groups[1].title, "Phase filter");
  EXPECT_EQ(figure.x.column, "labelled_s");
  EXPECT_EQ(figure.measures.front().low, "balanced_accuracy_low");
  EXPECT_THAT(figure.caption, HasSubstr("3 training sets of each size"));
  EXPECT_THAT(figure.alt, HasSubstr("0.95"));
}

}  // namespace
}  // namespace touchdown::experiments
