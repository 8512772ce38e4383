#pragma once

#include <LinearMath/btQuaternion.h>
#include <LinearMath/btTransform.h>
#include <LinearMath/btVector3.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <mujoco/mujoco.h>

namespace touchdown {

// Between Bullet's, Eigen's and MuJoCo's vectors and quaternions. MuJoCo's arrays hold quaternions
// as w x y z.

inline btVector3 to_bullet(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
inline btQuaternion to_bullet(const Eigen::Quaterniond& q) { return {q.x(), q.y(), q.z(), q.w()}; }
inline Eigen::Vector3d to_eigen(const btVector3& v) { return {v.x(), v.y(), v.z()}; }
inline Eigen::Quaterniond to_eigen(const btQuaternion& q) { return {q.w(), q.x(), q.y(), q.z()}; }
inline Eigen::Vector3d vector_at(const mjtNum* x, int row) {
  return {x[3 * row], x[3 * row + 1], x[3 * row + 2]};
}
inline Eigen::Quaterniond quaternion_at(const mjtNum* x, int row) {
  return {x[4 * row], x[4 * row + 1], x[4 * row + 2], x[4 * row + 3]};
}

}  // namespace touchdown
