#include "recordings/mapping/mounting.hpp"

#include <cmath>
#include <vector>

#include <Eigen/Geometry>

#include "core/fields.hpp"

namespace touchdown::recordings {

namespace {

Eigen::Matrix3d rotation_of_angles(const std::vector<double>& angles, double unit) {
  return (Eigen::AngleAxisd(unit * angles[2], Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(unit * angles[1], Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(unit * angles[0], Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

}  // namespace

void describe_mounting(Fields& fields, Eigen::Matrix3d& axes) {
  std::vector<double> quaternion;
  std::vector<double> angles;
  std::size_t unit = 0;
  for (const char* key : {"quaternion", "rpy", "unit"}) fields.know(key);
  fields.finish();
  const bool has_quaternion = fields.present("quaternion", false);
  const bool has_angles = fields.present("rpy", false);
  if (has_quaternion) {
    fields.in_line("quaternion", quaternion)
        .range("four numbers of length 1")
        .fallback("none")
        .doc("w, x, y, z.");
  }
  if (has_angles) {
    fields.in_line("rpy", angles)
        .range("three numbers")
        .fallback("none")
        .doc("Roll, pitch and yaw, instead of `quaternion`.");
  }
  fields.choose("unit", {"rad", "deg"}, unit).doc("Unit of roll, pitch and yaw.");
  if (fields.documenting()) return;
  fields.check(has_quaternion != has_angles, "",
               "expected either 'quaternion' (w, x, y, z) or 'rpy' (roll, pitch, yaw)");
  Eigen::Matrix3d to_robot = Eigen::Matrix3d::Identity();
  if (has_quaternion) {
    fields.check(quaternion.size() == 4, "quaternion", "expected w, x, y, z");
    const Eigen::Quaterniond q(quaternion[0], quaternion[1], quaternion[2], quaternion[3]);
    constexpr double tolerance = 0.02;
    fields.check(std::abs(q.norm() - 1.0) <= tolerance, "quaternion",
                 "expected four numbers of length 1: w, x, y, z");
    to_robot = q.normalized().toRotationMatrix();
  } else {
    constexpr double degree = 3.14159265358979323846 / 180.0;
    fields.check(angles.size() == 3, "rpy", "expected roll, pitch and yaw");
    for (const double angle : angles) fields.check(std::isfinite(angle), "rpy", "expected angles");
    to_robot = rotation_of_angles(angles, unit == 1 ? degree : 1.0);
  }
  // From forward, left, up to back, left, down.
  axes = Eigen::Vector3d(-1.0, 1.0, -1.0).asDiagonal() * to_robot;
}

}  // namespace touchdown::recordings
