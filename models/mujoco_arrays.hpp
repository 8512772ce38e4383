#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <mujoco/mujoco.h>

namespace touchdown::models {

// Rows of MuJoCo's arrays as Eigen's vectors and quaternions; MuJoCo holds these as w x y z.

inline Eigen::Vector3d vector_at(const mjtNum* x, int row) {
  return {x[3 * row], x[3 * row + 1], x[3 * row + 2]};
}
inline Eigen::Quaterniond quaternion_at(const mjtNum* x, int row) {
  return {x[4 * row], x[4 * row + 1], x[4 * row + 2], x[4 * row + 3]};
}

}  // namespace touchdown::models
