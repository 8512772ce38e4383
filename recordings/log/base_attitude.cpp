#include "recordings/log/base_attitude.hpp"

#include <algorithm>
#include <cmath>

namespace touchdown::recordings {

BaseAttitude base_attitude(const models::ImuReading& imu) {
  const Eigen::DiagonalMatrix<double, 3> base_to_imu(-1.0, 1.0, -1.0);
  const Eigen::DiagonalMatrix<double, 3> ars_to_world(1.0, -1.0, -1.0);
  BaseAttitude attitude;
  Eigen::Matrix3d& rotation = attitude.base_to_world;
  rotation = ars_to_world * imu.orientation.normalized().toRotationMatrix() * base_to_imu;
  attitude.angular_velocity = base_to_imu * imu.angular_velocity;
  attitude.pitch = std::asin(std::clamp(-rotation(2, 0), -1.0, 1.0));
  attitude.pitch_rate = attitude.angular_velocity.y();
  attitude.yaw = std::atan2(rotation(1, 0), rotation(0, 0));
  attitude.yaw_rate = rotation.row(2).dot(attitude.angular_velocity);
  return attitude;
}

}  // namespace touchdown::recordings
