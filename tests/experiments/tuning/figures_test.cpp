#include "experiments/tuning/figures.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace touchdown::experiments {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(TuningFigure, HasARowPerEstimatorAndListsTheChosenTrials) {
  const Table table = from_csv(
      "simulator,fit,estimator,trial,hyperparameters,balanced_accuracy,chosen\n"
      "mujoco,,robust,0,a=1,0.5,0\n"
      "mujoco,,robust,1,a=2,0.75,1\n"
      "mujoco,upkie_ideal,phase,0,,0.625,1\n");
  Experiment experiment;
  experiment.tuning.emplace();
  const FigureSpec figure = tuning_figure(table, experiment);
  EXPECT_EQ(figure.rows.groups.size(), 2U);
  EXPECT_EQ(figure.panels.groups.size(), 2U);
  EXPECT_THAT(figure.alt, HasSubstr("MuJoCo: 0.75 for Bayes filter (robust)"));
  EXPECT_THAT(figure.alt, HasSubstr("upkie_ideal, MuJoCo: 0.625 for Phase filter"));
  EXPECT_THAT(figure.alt, Not(HasSubstr("0.5 ")));
}

}  // namespace
}  // namespace touchdown::experiments
