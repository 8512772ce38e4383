#include "experiments/studies/cross_simulator/figures.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/studies/cross_simulator/config.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::ElementsAre;

Experiment two_engines() {
  Experiment experiment;
  experiment.simulators = {"mujoco", "bullet"};
  experiment.highlights = {{}};
  experiment.studies.emplace<CrossSimulatorConfig>();
  return experiment;
}

TEST(TransferFigure, HasBothDirectionsOfTheFittedEstimators) {
  const Table table = from_csv(
      "torque_noise_nm,accelerometer_noise_mps2,estimator,fit_simulator,test_simulator,is_fitted,"
      "loss,loss_low,loss_high,gain,gain_low,gain_high\n"
      "1,5,robust,mujoco,mujoco,1,0,0,0,0.1,0,0.2\n"
      "1,5,robust,mujoco,bullet,1,0.01,0,0.02,0.1,0,0.2\n"
      "1,5,free_fall,mujoco,bullet,0,0,0,0,0.1,0,0.2\n");
  const FigureSpec figure = transfer_figure(table, two_engines());
  ASSERT_EQ(figure.series.groups.size(), 2U);
  EXPECT_THAT(figure.series.groups[0].values, ElementsAre("mujoco", "bullet"));
  EXPECT_THAT(figure.series.groups[1].values, ElementsAre("bullet", "mujoco"));
  ASSERT_EQ(figure.rows.groups.size(), 1U);
  EXPECT_EQ(figure.rows.groups[0].title, "Bayes filter (robust)");
}

TEST(SensitivityFigures, AreOnePerEngineThatHasFactors) {
  const std::string header =
      "factor,value,nominal,simulator,estimator,success,success_low,success_high\n";
  const Table table = from_csv(header +
                               "friction,0.5,1,mujoco,robust,0.9,0.8,1\n"
                               "\"step, µs\",250,500,mujoco,robust,0.9,0.8,1\n");
  const std::vector<FigureSpec> figures = sensitivity_figures(table, two_engines());
  ASSERT_EQ(figures.size(), 1U);
  EXPECT_EQ(figures[0].name, "sensitivity_mujoco");
  ASSERT_EQ(figures[0].panels.groups.size(), 2U);
  EXPECT_EQ(figures[0].panels.groups[1].title, "step, µs");
  EXPECT_TRUE(sensitivity_figures(from_csv(header), two_engines()).empty());
}

}  // namespace
}  // namespace touchdown::experiments
