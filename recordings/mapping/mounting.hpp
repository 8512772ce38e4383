#pragma once

#include <Eigen/Core>

namespace touchdown {
class Fields;
}

namespace touchdown::recordings {

/// Reads how an IMU is mounted: the rotation from its axes to the robot's (x forward, y left, z
/// up), as a quaternion w x y z or as roll, pitch and yaw, as in a URDF (a rotation about x, then
/// y, then z). Sets the rotation from the IMU's axes to those of Upkie's IMU (back, left, down).
void describe_mounting(Fields& fields, Eigen::Matrix3d& axes);

}  // namespace touchdown::recordings
