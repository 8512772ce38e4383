#include "scoring/trajectory.hpp"

#include <cmath>
#include <iterator>

#include <Eigen/LU>
#include <Eigen/SVD>
#include <fmt/format.h>

#include "core/error.hpp"

namespace touchdown::scoring {

namespace {

/// Length of the path segments of relative errors (m).
constexpr double segment_length = 1.0;

double root_mean(double sum, std::int64_t count) {
  return std::sqrt(sum / static_cast<double>(count));  // NaN of nothing
}

double heading(const Eigen::Quaterniond& orientation) {
  const Eigen::Vector3d forward = orientation * Eigen::Vector3d::UnitX();
  return std::atan2(forward.y(), forward.x());
}

}  // namespace

double TrajectoryScore::rms() const { return root_mean(squared_horizontal, steps); }
double TrajectoryScore::height_rms() const { return root_mean(squared_vertical, steps); }
double TrajectoryScore::velocity_rms() const { return root_mean(squared_velocity, steps); }
double TrajectoryScore::ate() const { return root_mean(squared_aligned, steps); }
double TrajectoryScore::error_per_metre() const {
  return root_mean(squared_segment_level, segments) / segment_length;
}
double TrajectoryScore::rpe() const { return root_mean(squared_segment, segments); }
double TrajectoryScore::end_per_metre() const { return end / distance; }

TrajectoryScore& TrajectoryScore::operator+=(const TrajectoryScore& other) {
  steps += other.steps;
  squared_horizontal += other.squared_horizontal;
  squared_vertical += other.squared_vertical;
  squared_velocity += other.squared_velocity;
  squared_aligned += other.squared_aligned;
  segments += other.segments;
  squared_segment_level += other.squared_segment_level;
  squared_segment += other.squared_segment;
  end += other.end;
  distance += other.distance;
  runs += other.runs;
  return *this;
}

Eigen::Isometry3d aligned(const Trajectory& from, const Trajectory& to) {
  Eigen::Vector3d from_middle = Eigen::Vector3d::Zero();
  Eigen::Vector3d to_middle = Eigen::Vector3d::Zero();
  const double share = 1.0 / static_cast<double>(from.size());
  for (std::size_t k = 0; k < from.size(); ++k) {
    from_middle += share * from[k].position;
    to_middle += share * to[k].position;
  }
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
  for (std::size_t k = 0; k < from.size(); ++k) {
    products += share * (to[k].position - to_middle) * (from[k].position - from_middle).transpose();
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(products, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs = Eigen::Vector3d::Ones();  // no mirror image
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0) signs.z() = -1.0;
  Eigen::Isometry3d moved = Eigen::Isometry3d::Identity();
  moved.linear() = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  moved.translation() = to_middle - moved.linear() * from_middle;
  return moved;
}

std::vector<std::size_t> segment_ends(const Trajectory& path, double length) {
  std::vector<std::size_t> at;
  double travelled = 0.0;
  for (std::size_t k = 1; k < path.size(); ++k) {
    travelled += (path[k].position - path[k - 1].position).norm();
    if (travelled < length) continue;
    at.push_back(k);
    travelled = 0.0;
  }
  return at;
}

Trajectory aligned_at_start(const Trajectory& trajectory, const TimedPose& begin) {
  const TimedPose& first = trajectory.front();
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(
      heading(begin.orientation) - heading(first.orientation), Eigen::Vector3d::UnitZ()));
  Trajectory moved = trajectory;
  for (TimedPose& pose : moved) {
    pose.position = begin.position + turn * (pose.position - first.position);
    pose.orientation = turn * pose.orientation;
    pose.velocity = turn * pose.velocity;
  }
  return moved;
}

TrajectoryScore score_trajectory(const Trajectory& estimate, const Trajectory& truth,
                                 std::size_t first) {
  if (estimate.size() != truth.size()) {
    throw Error(fmt::format("a trajectory of {} poses cannot be scored against one of {}",
                            estimate.size(), truth.size()));
  }
  TrajectoryScore score;
  if (first >= truth.size()) return score;
  const auto offset = static_cast<std::ptrdiff_t>(first);
  const Trajectory true_poses(truth.begin() + offset, truth.end());
  const Trajectory estimated =
      aligned_at_start(Trajectory(estimate.begin() + offset, estimate.end()), true_poses.front());
  const Eigen::Isometry3d alignment = aligned(estimated, true_poses);
  score.runs = 1;
  score.steps = static_cast<std::int64_t>(true_poses.size());
  for (std::size_t k = 0; k < true_poses.size(); ++k) {
    const Eigen::Vector3d error = estimated[k].position - true_poses[k].position;
    score.squared_horizontal += error.head<2>().squaredNorm();
    score.squared_vertical += error.z() * error.z();
    score.squared_velocity += (estimated[k].velocity - true_poses[k].velocity).squaredNorm();
    score.squared_aligned +=
        (alignment * estimated[k].position - true_poses[k].position).squaredNorm();
    if (k == 0) continue;
    score.distance += (true_poses[k].position - true_poses[k - 1].position).head<2>().norm();
  }
  score.end = (estimated.back().position - true_poses.back().position).head<2>().norm();
  const std::vector<std::size_t> at = segment_ends(true_poses, segment_length);
  for (std::size_t m = 1; m < at.size(); ++m) {
    const std::size_t i = at[m - 1];
    const std::size_t j = at[m];
    const Eigen::Vector3d estimated_step =
        estimated[i].orientation.conjugate() * (estimated[j].position - estimated[i].position);
    const Eigen::Vector3d error = true_poses[i].orientation * estimated_step -
                                  (true_poses[j].position - true_poses[i].position);
    score.squared_segment += error.squaredNorm();
    score.squared_segment_level += error.head<2>().squaredNorm();
    ++score.segments;
  }
  return score;
}

std::string to_tum(const Trajectory& trajectory, std::size_t stride) {
  std::string text = "# t x y z qx qy qz qw\n";
  for (std::size_t k = 0; k < trajectory.size(); k += stride) {
    const TimedPose& pose = trajectory[k];
    const Eigen::Vector3d& p = pose.position;
    const Eigen::Quaterniond& q = pose.orientation;
    fmt::format_to(std::back_inserter(text), "{} {} {} {} {} {} {} {}\n", pose.time, p.x(), p.y(),
                   p.z(), q.x(), q.y(), q.z(), q.w());
  }
  return text;
}

}  // namespace touchdown::scoring
