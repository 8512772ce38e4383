#include <gtest/gtest.h>

#include "render/film/scene_view.hpp"

namespace touchdown::render {
namespace {

TEST(CameraPath, FollowsAStraightRideWithoutLag) {
  std::vector<Eigen::Vector3d> ride;
  for (int k = 0; k < 10'000; ++k) ride.emplace_back(5e-4 * k, 0.0, 1.0);
  const auto path = smoothed(ride, 1e-3, 0.35);
  EXPECT_NEAR(path[5'000].x(), ride[5'000].x(), 1e-3);
  EXPECT_DOUBLE_EQ(path[5'000].z(), 1.0);
}

TEST(CameraPath, HalvesAStepInItsMiddle) {
  std::vector<Eigen::Vector3d> step(8'001, Eigen::Vector3d::Zero());
  for (std::size_t k = 4'000; k < step.size(); ++k) step[k].z() = 1.0;
  const auto path = smoothed(step, 1e-3, 0.35);
  EXPECT_NEAR(path[4'000].z(), 0.5, 2e-3);
  for (std::size_t k = 1; k < path.size(); ++k) {
    EXPECT_LT(path[k].z() - path[k - 1].z(), 1e-3 / 0.35);  // no jerk
  }
}

TEST(CameraPath, EmptyAndSingleStayAsTheyAre) {
  EXPECT_TRUE(smoothed({}, 1e-3, 0.35).empty());
  EXPECT_EQ(smoothed({Eigen::Vector3d(1, 2, 3)}, 1e-3, 0.35)[0], Eigen::Vector3d(1, 2, 3));
}

}  // namespace
}  // namespace touchdown::render
