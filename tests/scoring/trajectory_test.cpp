#include "scoring/trajectory.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::scoring {
namespace {

using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;

Quaterniond turned(double yaw) { return Quaterniond(AngleAxisd(yaw, Vector3d::UnitZ())); }

/// A pose at rest.
TimedPose at(double time, const Vector3d& position,
             const Quaterniond& orientation = Quaterniond::Identity()) {
  return {time, position, orientation, Vector3d::Zero()};
}

/// A straight path along x in steps of `stride`, scaled by `scale`.
Trajectory straight(int count, double stride, double scale = 1.0) {
  Trajectory path;
  for (int k = 0; k < count; ++k) {
    path.push_back({0.1 * k,
                    {scale * stride * k, 0, 0},
                    Quaterniond::Identity(),
                    {10.0 * scale * stride, 0, 0}});
  }
  return path;
}

TEST(TrajectoryScore, OfATooShortPathMatchesHandCalculation) {
  // Truth at 0, 1, 2, 3 m; estimate at 0, .9, 1.8, 2.7 m: errors 0, .1, .2, .3 m.
  const TrajectoryScore score = score_trajectory(straight(4, 1.0, 0.9), straight(4, 1.0));
  EXPECT_EQ(score.steps, 4);
  EXPECT_EQ(score.runs, 1);
  EXPECT_NEAR(score.rms(), std::sqrt(0.14 / 4), 1e-12);
  EXPECT_NEAR(score.velocity_rms(), 1.0, 1e-12);  // 9 for 10 m/s
  EXPECT_NEAR(score.height_rms(), 0.0, 1e-12);
  EXPECT_NEAR(score.distance, 3.0, 1e-12);
  EXPECT_NEAR(score.end_per_metre(), 0.1, 1e-12);
  // Segments end at 1, 2, 3 m: two are scored, each .1 m too short.
  EXPECT_EQ(score.segments, 2);
  EXPECT_NEAR(score.error_per_metre(), 0.1, 1e-12);
  EXPECT_NEAR(score.rpe(), 0.1, 1e-12);
  // Aligned at their centres, the errors are ±.15 and ±.05 m.
  EXPECT_NEAR(score.ate(), std::sqrt((2 * 0.0225 + 2 * 0.0025) / 4), 1e-12);
}

TEST(TrajectoryScore, IgnoresTheOriginAndTheHeading) {
  const Trajectory truth = straight(50, 0.1);
  Trajectory estimate = truth;
  for (TimedPose& pose : estimate) {
    pose.position = turned(1.0) * pose.position + Vector3d(5, 6, 7);
    pose.orientation = turned(1.0) * pose.orientation;
    pose.velocity = turned(1.0) * pose.velocity;
  }
  const TrajectoryScore score = score_trajectory(estimate, truth);
  EXPECT_LT(score.rms() + score.velocity_rms() + score.ate() + score.rpe() + score.height_rms(),
            1e-9);
}

TEST(TrajectoryScore, OfAWrongHeadingGrowsWithTheDistance) {
  // The estimate starts correctly, then heads .1 rad to the left: chords of 2 sin(.05).
  const Trajectory truth = straight(41, 0.1);
  Trajectory estimate = truth;
  for (std::size_t k = 1; k < estimate.size(); ++k) {
    estimate[k].position = turned(0.1) * estimate[k].position;
    estimate[k].orientation = turned(0.1);
  }
  const TrajectoryScore score = score_trajectory(estimate, truth);
  EXPECT_NEAR(score.end, 4.0 * 2.0 * std::sin(0.05), 1e-12);
  EXPECT_NEAR(score.ate(), 0.0, 1e-9);  // the whole path can be aligned with the truth
  EXPECT_NEAR(score.rpe(), 0.0, 1e-9);  // and so can each metre, with its rotated first pose
}

TEST(TrajectoryScore, SeparatesHeightFromHorizontalErrors) {
  Trajectory estimate = straight(21, 0.1);
  for (TimedPose& pose : estimate) pose.position.z() = 0.2 * pose.position.x();
  const TrajectoryScore score = score_trajectory(estimate, straight(21, 0.1));
  EXPECT_NEAR(score.rms(), 0.0, 1e-12);
  EXPECT_NEAR(score.error_per_metre(), 0.0, 1e-12);
  EXPECT_NEAR(score.rpe(), 0.2, 1e-12);
  double squares = 0.0;
  for (int k = 0; k <= 20; ++k) squares += std::pow(0.02 * k, 2);
  EXPECT_NEAR(score.height_rms(), std::sqrt(squares / 21), 1e-12);
}

TEST(TrajectoryScore, LeavesOutTheBeginning) {
  Trajectory estimate = straight(31, 0.1);
  for (std::size_t k = 0; k < 10; ++k) estimate[k].position.y() = 3.0;
  EXPECT_GT(score_trajectory(estimate, straight(31, 0.1)).rms(), 1.0);
  const TrajectoryScore score = score_trajectory(estimate, straight(31, 0.1), 10);
  EXPECT_EQ(score.steps, 21);
  EXPECT_NEAR(score.rms(), 0.0, 1e-12);
  EXPECT_NEAR(score.distance, 2.0, 1e-12);
  EXPECT_TRUE(std::isnan(score_trajectory(estimate, straight(31, 0.1), 31).rms()));
}

TEST(TrajectoryScore, OfSeveralRunsIsThatOfTheirSums) {
  const TrajectoryScore one = score_trajectory(straight(4, 1.0, 0.9), straight(4, 1.0));
  TrajectoryScore both = one;
  both += score_trajectory(straight(4, 1.0), straight(4, 1.0));
  EXPECT_EQ(both.runs, 2);
  EXPECT_NEAR(both.rms(), std::sqrt(0.14 / 8), 1e-12);
  EXPECT_NEAR(both.error_per_metre(), 0.1 / std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(both.end_per_metre(), 0.05, 1e-12);
}

TEST(TrajectoryScore, RefusesTrajectoriesOfDifferentLength) {
  EXPECT_THROW(score_trajectory(straight(4, 1.0), straight(5, 1.0)), Error);
}

TEST(Alignment, FindsTheMotionBetweenTwoTrajectories) {
  Trajectory from;
  for (int k = 0; k < 20; ++k) {
    from.push_back(at(0.0, {std::cos(0.5 * k), 0.1 * k, std::sin(0.3 * k)}));
  }
  const Eigen::Isometry3d motion =
      Eigen::Translation3d(1, -2, 3) * AngleAxisd(2.5, Vector3d(1, 2, -1).normalized());
  Trajectory to = from;
  for (TimedPose& pose : to) pose.position = motion * pose.position;
  EXPECT_LT((aligned(from, to).matrix() - motion.matrix()).norm(), 1e-12);
}

TEST(Alignment, IsNeverAMirrorImage) {
  // A plane letter F and its mirror image: half a turn about its stem is the best rotation.
  Trajectory from, to;
  for (const Vector3d& p : {Vector3d(0, 0, 0), Vector3d(0, 1, 0), Vector3d(0, 2, 0),
                            Vector3d(1, 2, 0), Vector3d(0.5, 1, 0)}) {
    from.push_back(at(0.0, p));
    to.push_back(at(0.0, {-p.x(), p.y(), 0}));
  }
  const Eigen::Isometry3d found = aligned(from, to);
  EXPECT_NEAR(found.linear().determinant(), 1.0, 1e-12);
  EXPECT_LT((found * Vector3d(1, 2, 0) - Vector3d(-1, 2, 0)).norm(), 1e-12);
}

TEST(SegmentEnds, AreAtMultiplesOfTheLength) {
  EXPECT_THAT(segment_ends(straight(12, 0.25), 1.0), ::testing::ElementsAre(4, 8));
  EXPECT_THAT(segment_ends(straight(3, 0.25), 1.0), ::testing::IsEmpty());
}

TEST(Tum, IsALinePerPoseWithTheScalarLast) {
  const Trajectory path = {at(0.0, {1, 2, 3}), at(0.5, {0.1, 0, -4}, Quaterniond(0, 0, 0, 1)),
                           at(1.0, {7, 8, 9}, Quaterniond(0, 1, 0, 0))};
  EXPECT_EQ(to_tum(path),
            "# t x y z qx qy qz qw\n0 1 2 3 0 0 0 1\n0.5 0.1 0 -4 0 0 1 0\n1 7 8 9 1 0 0 0\n");
  EXPECT_EQ(to_tum(path, 2), "# t x y z qx qy qz qw\n0 1 2 3 0 0 0 1\n1 7 8 9 1 0 0 0\n");
}

/// Errors of an estimate by `evo`: absolute trajectory error after aligning the whole trajectory,
/// and relative pose error over a metre of the true path.
constexpr const char* script = R"(import sys
from evo.core import metrics
from evo.tools import file_interface
truth, estimate = (file_interface.read_tum_trajectory_file(path) for path in sys.argv[1:3])
rpe = metrics.RPE(metrics.PoseRelation.translation_part, 1.0, metrics.Unit.meters,
                  all_pairs=False, pairs_from_reference=True)
rpe.process_data((truth, estimate))
estimate.align(truth)
ape = metrics.APE(metrics.PoseRelation.translation_part)
ape.process_data((truth, estimate))
print(*("%.12f" % one.get_statistic(metrics.StatisticsType.rmse) for one in (ape, rpe)))
)";

/// A winding path over hills; `scale` and `drift` add errors of scale, heading and position.
Trajectory winding(double scale, double drift) {
  Trajectory path;
  for (int k = 0; k < 2000; ++k) {
    const double t = 0.01 * k;
    const double yaw = 0.4 * std::sin(0.7 * t) + drift * t;
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
    const Eigen::Vector3d position(scale * 0.6 * t, std::sin(0.5 * t) + drift * t * t,
                                   0.2 * std::sin(t));
    path.push_back({t, position, turn, Eigen::Vector3d::Zero()});
  }
  return path;
}

TEST(Evo, AgreesAboutAbsoluteAndRelativeErrors) {
  if (std::system("python3 -c 'import evo' 2> /dev/null") != 0) {
    GTEST_SKIP() << "evo is not installed (no Debian package; `pip install evo`)";
  }
  const Trajectory truth = winding(1.0, 0.0);
  const Trajectory estimate = winding(1.02, 0.01);
  const ScratchFolder folder;
  const std::string command =
      fmt::format("python3 {} {} {}", folder.write("errors.py", script).string(),
                  folder.write("truth.tum", to_tum(truth)).string(),
                  folder.write("estimate.tum", to_tum(estimate)).string());
  const std::unique_ptr<FILE, int (*)(FILE*)> evo(::popen(command.c_str(), "r"), ::pclose);
  std::array<double, 2> errors = {};
  ASSERT_EQ(std::fscanf(evo.get(), "%lf %lf", errors.data(), &errors[1]), 2) << command;
  const TrajectoryScore score = score_trajectory(estimate, truth);
  EXPECT_NEAR(score.ate(), errors[0], 1e-6);
  EXPECT_NEAR(score.rpe(), errors[1], 1e-6);
}

}  // namespace
}  // namespace touchdown::scoring
