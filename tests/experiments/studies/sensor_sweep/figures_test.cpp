#include "experiments/studies/sensor_sweep/figures.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace touchdown::experiments {
namespace {

TEST(SensorSweepFigures, AreOnePerEngineWithAPanelPerDisturbance) {
  const Table table = from_csv(
      "simulator,disturbance,value,estimator,success,success_low,success_high\n"
      "mujoco,torque.bias,0.05,robust,0.9,0.8,1\n"
      "mujoco,torque.bias,0.2,robust,0.8,0.7,0.9\n"
      "mujoco,dropout,0.01,robust,0.8,0.7,0.9\n"
      "bullet,dropout,0.01,robust,0.8,0.7,0.9\n");
  Experiment experiment;
  experiment.simulators = {"mujoco", "bullet"};
  experiment.highlights = {{}};
  const std::vector<FigureSpec> figures = sensor_sweep_figures(table, experiment);
  ASSERT_EQ(figures.size(), 2U);
  EXPECT_EQ(figures[0].name, "sensor_sweep_mujoco");
  ASSERT_EQ(figures[0].panels.groups.size(), 2U);
  EXPECT_EQ(figures[0].panels.groups[0].title, "torque.bias");
  EXPECT_EQ(figures[0].panels.groups[1].title, "dropout");
  EXPECT_EQ(figures[1].panels.groups.size(), 1U);
}

}  // namespace
}  // namespace touchdown::experiments
