#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace touchdown::scoring {

/// Pose and velocity of a body at one time. The z axis of the world points up.
struct TimedPose {
  double time = 0.0;                                                ///< s
  Eigen::Vector3d position = Eigen::Vector3d::Zero();               ///< m
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< from the body to the world
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();               ///< m/s
};
using Trajectory = std::vector<TimedPose>;

/// Sums of squared errors of estimated trajectories, which docs/reference/metrics.md defines, and
/// the metrics computed from them. A metric is NaN if its denominator is zero.
struct TrajectoryScore {
  std::int64_t steps = 0;
  double squared_horizontal = 0.0;     ///< errors after aligning the first poses (m²)
  double squared_vertical = 0.0;       ///< the same, vertical (m²)
  double squared_velocity = 0.0;       ///< m²/s²
  double squared_aligned = 0.0;        ///< errors after aligning the whole trajectory (m²)
  std::int64_t segments = 0;           ///< of one metre of the true path
  double squared_segment_level = 0.0;  ///< horizontal displacement errors over a segment (m²)
  double squared_segment = 0.0;        ///< displacement errors over a segment, 3D (m²)
  double end = 0.0;                    ///< horizontal error at the end (m)
  double distance = 0.0;               ///< true horizontal distance travelled (m)
  std::int64_t runs = 0;

  double rms() const;              ///< of the horizontal error (m)
  double height_rms() const;       ///< m
  double velocity_rms() const;     ///< m/s
  double ate() const;              ///< absolute trajectory error (m)
  double error_per_metre() const;  ///< of horizontal displacement
  double rpe() const;              ///< relative pose error over a metre (m)
  double end_per_metre() const;

  TrajectoryScore& operator+=(const TrajectoryScore& other);
};

/// Scores an estimate against the truth, pose by pose from `first` on. Errors: `Error` if the
/// numbers of poses differ.
TrajectoryScore score_trajectory(const Trajectory& estimate, const Trajectory& truth,
                                 std::size_t first = 0);

/// The rotation and translation that align the positions of `from` to those of `to` with the least
/// sum of squares (Umeyama 1991), without a scale.
Eigen::Isometry3d aligned(const Trajectory& from, const Trajectory& to);

/// Steps that end path segments of `length` (m): each begins where the last one ends, the first at
/// 0.
std::vector<std::size_t> segment_ends(const Trajectory& path, double length);

/// The trajectory, moved and turned about the vertical so that it begins at the position and
/// heading of `begin`, which odometry cannot observe.
Trajectory aligned_at_start(const Trajectory& trajectory, const TimedPose& begin);

/// The trajectory in the TUM format, which `evo` reads: a line `t x y z qx qy qz qw` for every
/// `stride`-th pose, with all digits.
std::string to_tum(const Trajectory& trajectory, std::size_t stride = 1);

}  // namespace touchdown::scoring
