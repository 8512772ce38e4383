#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace touchdown::scoring {

/// Where something is, how it is turned and how fast it moves, in a world whose z axis points up.
struct TimedPose {
  double time = 0.0;                                                ///< s
  Eigen::Vector3d position = Eigen::Vector3d::Zero();               ///< m
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< from the body to the world
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();               ///< m/s
};
using Trajectory = std::vector<TimedPose>;

/// Everything that is summed of estimated trajectories; docs/metrics.md defines it. NaN where there
/// is nothing to divide by.
struct TrajectoryScore {
  std::int64_t steps = 0;
  double squared_horizontal = 0.0;  ///< errors with the first poses on each other (m²)
  double squared_vertical = 0.0;    ///< likewise
  double squared_velocity = 0.0;    ///< m²/s²
  double squared_aligned = 0.0;     ///< errors with all of the trajectory laid on the truth (m²)
  std::int64_t segments = 0;        ///< of one metre of the true way
  double squared_segment_level = 0.0;  ///< errors of the horizontal way over one (m²)
  double squared_segment = 0.0;        ///< of the way in all three dimensions (m²)
  double end = 0.0;                    ///< horizontal error at the end (m)
  double distance = 0.0;               ///< horizontal, truly travelled (m)
  std::int64_t runs = 0;

  double rms() const;              ///< of the horizontal error (m)
  double height_rms() const;       ///< m
  double velocity_rms() const;     ///< m/s
  double ate() const;              ///< absolute trajectory error (m)
  double error_per_metre() const;  ///< of the horizontal way
  double rpe() const;              ///< relative pose error over a metre (m)
  double end_per_metre() const;

  TrajectoryScore& operator+=(const TrajectoryScore& other);
};

/// Scores an estimate against the truth, pose by pose from `first` on. Errors: `Error` unless there
/// are as many poses.
TrajectoryScore score_trajectory(const Trajectory& estimate, const Trajectory& truth,
                                 std::size_t first = 0);

/// The rotation and translation that lay one trajectory's places on another's with the least sum of
/// squares (Umeyama 1991), without a scale.
Eigen::Isometry3d aligned(const Trajectory& from, const Trajectory& to);

/// Steps at which the way since the last such step, and since the first one, has come to `length`.
std::vector<std::size_t> marks(const Trajectory& way, double length);

/// The trajectory, moved and turned about the vertical so that it begins as another one does: place
/// and heading, which no odometry knows.
Trajectory begun_as(const Trajectory& trajectory, const TimedPose& begin);

/// As TUM's benchmark writes trajectories, and `evo` reads them: a line `t x y z qx qy qz qw` of
/// every `stride`-th pose, all digits.
std::string to_tum(const Trajectory& trajectory, std::size_t stride = 1);

}  // namespace touchdown::scoring
