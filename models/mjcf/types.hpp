#pragma once

#include <algorithm>
#include <memory>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <mujoco/mujoco.h>

namespace touchdown::models {

struct MjModelDeleter {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
};
using MjModelPtr = std::unique_ptr<mjModel, MjModelDeleter>;

struct MjDataDeleter {
  void operator()(mjData* data) const { mj_deleteData(data); }
};
using MjDataPtr = std::unique_ptr<mjData, MjDataDeleter>;

/// Errors: `Error` when memory is out.
MjDataPtr make_data(const mjModel& model);

// Rows of MuJoCo's arrays as Eigen vectors and quaternions. MuJoCo stores quaternions as w x y z.

inline Eigen::Vector3d vector_at(const mjtNum* x, int row) {
  return {x[3 * row], x[3 * row + 1], x[3 * row + 2]};
}
inline Eigen::Quaterniond quaternion_at(const mjtNum* x, int row) {
  return {x[4 * row], x[4 * row + 1], x[4 * row + 2], x[4 * row + 3]};
}

inline void set_quaternion(mjtNum* x, int row, const Eigen::Quaterniond& q) {
  const mjtNum wxyz[] = {q.w(), q.x(), q.y(), q.z()};
  std::copy_n(wxyz, 4, x + 4 * row);
}

}  // namespace touchdown::models
