#pragma once

#include <cmath>
#include <cstdint>

#include <Eigen/Geometry>

#include "estimator/odometry/filter.hpp"
#include "tests/estimator/random.hpp"

namespace touchdown::odometry::test {

/// A wheeled biped with straight legs that rolls over level ground and leans. Its wheels roll
/// without slip by construction. The motion is in closed form; the measurements are its
/// differences.
class RollingRobot {
 public:
  static constexpr double step = 1e-3;  ///< s

  /// The true pose at a time as odometry defines it: of the IMU, with the axes of the base.
  ExtendedPose pose(double time) const {
    ExtendedPose pose;
    pose.rotation = orientation(time);
    pose.position = place(time);
    constexpr double h = 1e-5;
    pose.velocity = (place(time + h) - place(time - h)) / (2.0 * h);
    return pose;
  }

  /// The measurements of ideal sensors at step `k`. The accelerometer's mean over the step is in
  /// the frame at its end.
  OdometrySample sample(int k) const {
    const double time = k * step;
    constexpr double h = 1e-5;
    const Eigen::AngleAxisd turned(
        Eigen::Matrix3d(orientation(time - h).transpose() * orientation(time + h)));
    const Eigen::Matrix3d to_imu = robot.imu_in_base.transpose();
    OdometrySample sample;
    sample.time = time;
    sample.angular_velocity = to_imu * (turned.angle() / (2.0 * h) * turned.axis());
    sample.specific_force =
        to_imu * orientation(time).transpose() *
        ((pose(time).velocity - pose(time - step).velocity) / step + Eigen::Vector3d(0, 0, 9.81));
    for (std::size_t leg = 0; leg < 2; ++leg) {
      // The rotation of the wheel in the world minus the rotation of the base.
      const double side = robot.leg[leg].hip.y();
      const auto rolled = [&](double t) {
        return (distance(t) - side * heading(t)) / robot.wheel_radius - lean(t);
      };
      const double sign = robot.leg[leg].turn[2];
      sample.leg[leg].velocity[2] = sign * (rolled(time + h) - rolled(time - h)) / (2.0 * h);
      sample.p_contact[leg] = 1.0;
    }
    return sample;
  }

  WheeledBiped robot = upkie();

 private:
  static double distance(double t) { return 0.5 * t - 0.2 * std::sin(1.3 * t); }
  static double heading(double t) { return 0.4 * std::sin(0.7 * t) + 0.1 * t; }
  static double lean(double t) { return 0.1 * std::sin(2.9 * t) * t / (1.0 + t); }

  static Eigen::Matrix3d orientation(double t) {
    return (Eigen::AngleAxisd(heading(t), Eigen::Vector3d::UnitZ()) *
            Eigen::AngleAxisd(lean(t), Eigen::Vector3d::UnitY()))
        .toRotationMatrix();
  }

  Eigen::Vector3d place(double t) const {
    const double height = -(robot.leg[0].hip + robot.leg[0].upper + robot.leg[0].lower).z();
    return axle(t) + orientation(t) * Eigen::Vector3d(0, 0, height);
  }

  /// The middle of the axle: the integral of the speed along the heading, by Simpson's rule from
  /// a table's last point.
  Eigen::Vector3d axle(double t) const {
    const auto slope = [](double s) -> Eigen::Vector3d {
      const double speed = 0.5 - 0.26 * std::cos(1.3 * s);
      return {speed * std::cos(heading(s)), speed * std::sin(heading(s)), 0.0};
    };
    constexpr double interval = 0.01;
    const auto whole = static_cast<int>(std::floor(t / interval));
    while (static_cast<int>(table_.size()) <= whole) {
      const double from = interval * static_cast<double>(table_.size() - 1);
      table_.push_back(table_.back() + simpson(slope, from, from + interval));
    }
    if (whole < 0) return simpson(slope, 0.0, t);
    return table_[static_cast<std::size_t>(whole)] + simpson(slope, whole * interval, t);
  }

  template <typename Slope>
  static Eigen::Vector3d simpson(const Slope& slope, double a, double b) {
    return (b - a) / 6.0 * (slope(a) + 4.0 * slope(0.5 * (a + b)) + slope(b));
  }

  mutable std::vector<Eigen::Vector3d> table_ = {Eigen::Vector3d::Zero()};
};

}  // namespace touchdown::odometry::test
