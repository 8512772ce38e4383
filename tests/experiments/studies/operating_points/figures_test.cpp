#include "experiments/studies/operating_points/figures.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace touchdown::experiments {
namespace {

using ::testing::HasSubstr;

TEST(OperatingPointsFigure, HasAPanelPerNoiseSettingAndTheFrontOfEveryEstimator) {
  const Table table = from_csv(
      "torque_noise_nm,accelerometer_noise_mps2,estimator,leave_below,return_above,"
      "balanced_accuracy,extra_switches_per_minute,on_front\n"
      "0,0,robust,,,0.97,12,0\n"
      "0,0,robust,0.5,0.9,0.98,7,1\n"
      "0,0,phase,,,0.99,2,0\n"
      "1,5,robust,,,0.75,40,0\n");
  Experiment experiment;
  experiment.estimators = {"robust", "phase"};
  const FigureSpec figure = operating_points_figure(table, experiment);
  ASSERT_EQ(figure.panels.groups.size(), 2U);
  EXPECT_EQ(figure.panels.groups[0].title, "0 N·m, 0 m/s²");
  EXPECT_EQ(figure.panels.groups[1].title, "1 N·m, 5 m/s²");
  ASSERT_EQ(figure.series.groups.size(), 2U);
  EXPECT_EQ(figure.series.groups[0].title, "Bayes filter (robust)");
  EXPECT_EQ(figure.series.groups[1].title, "Phase filter");
  EXPECT_EQ(figure.colour_order, experiment.estimators);
  EXPECT_THAT(figure.caption, HasSubstr("normal force > 1 N"));
  EXPECT_THAT(figure.alt, HasSubstr("own decision 3.00 % with 12.0"));
}

}  // namespace
}  // namespace touchdown::experiments
