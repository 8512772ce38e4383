#include "experiments/studies/odometry/figures.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace touchdown::experiments {
namespace {

TEST(OdometryFigures, AreOnePerRobotWithItsSensorsAndRankTheContactSources) {
  const Table table = from_csv(
      "simulator,scenario,contact,rms_m,rms_m_low,rms_m_high,robot,sensors\n"
      "mujoco,stairs,always,0.1,0.1,0.1,upkie,ideal\n"
      "mujoco,stairs,phase,0.2,0.2,0.2,upkie,ideal\n"
      "mujoco,course,always,0.5,0.4,0.6,upkie,ideal\n"
      "mujoco,course,phase,0.2,0.1,0.3,upkie,ideal\n"
      "mujoco,course,phase,0.2,0.1,0.3,upkie,noisy\n");
  const std::vector<FigureSpec> figures = odometry_figures(table, {});
  ASSERT_EQ(figures.size(), 2U);
  EXPECT_EQ(figures[0].name, "odometry_upkie_ideal");
  EXPECT_EQ(figures[1].name, "odometry_upkie_noisy");
  EXPECT_EQ(figures[0].panels.groups.size(), 2U);
  ASSERT_EQ(figures[0].rows.groups.size(), 2U);  // the sums are 0.4 and 0.6
  EXPECT_EQ(figures[0].rows.groups[0].title, "Phase filter");
  EXPECT_EQ(figures[0].rows.groups[1].title, "Always contact");
  EXPECT_EQ(figures[1].rows.groups.size(), 1U);
}

}  // namespace
}  // namespace touchdown::experiments
