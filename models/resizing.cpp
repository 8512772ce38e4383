#include "models/resizing.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "core/error.hpp"

namespace touchdown::models {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// An affine map of a body's frame: a point x moves to pivot + linear·(x − pivot).
struct Stretch {
  Vector3d pivot;
  Matrix3d linear;

  Vector3d operator()(const Vector3d& x) const { return pivot + linear * (x - pivot); }
  /// The factor by which a line along `direction` gets longer.
  double along(const Vector3d& direction) const { return (linear * direction).norm(); }
};

Stretch along(const Vector3d& direction, double factor, const Vector3d& pivot) {
  return {pivot, Matrix3d::Identity() + (factor - 1.0) * direction * direction.transpose()};
}
Stretch across(const Vector3d& axis, double factor, const Vector3d& pivot) {
  return {pivot, factor * Matrix3d::Identity() - (factor - 1.0) * axis * axis.transpose()};
}

/// A row of three numbers in one of MuJoCo's arrays, writable.
Eigen::Map<Vector3d> row(mjtNum* table, int i) { return Eigen::Map<Vector3d>(table + 3 * i); }

/// The axes of a frame, from its quaternion in a row of one of MuJoCo's arrays.
Matrix3d axes_at(const mjtNum* table, int i) { return quaternion_at(table, i).toRotationMatrix(); }

/// Stretches the matter of a body: with Σ = ∫ρxxᵀ, the inertia is tr(Σ)·1 − Σ.
void stretch_inertia(mjModel& mj, int body, const Stretch& stretch) {
  const Matrix3d axes = axes_at(mj.body_iquat, body);
  const Vector3d inertia = row(mj.body_inertia, body);
  const Vector3d moments = Vector3d::Constant(0.5 * inertia.sum()) - inertia;
  const Matrix3d turned = stretch.linear * axes;
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solved(turned * moments.asDiagonal() *
                                                       turned.transpose());
  Matrix3d principal = solved.eigenvectors();
  if (principal.determinant() < 0.0) principal.col(0) *= -1.0;
  set_quaternion(mj.body_iquat, body, Eigen::Quaterniond(principal));
  row(mj.body_inertia, body) =
      Vector3d::Constant(solved.eigenvalues().sum()) - solved.eigenvalues();
}

double bounding_radius(int type, const Vector3d& size) {
  switch (type) {
    case mjGEOM_SPHERE:
      return size[0];
    case mjGEOM_CAPSULE:
      return size[0] + size[1];
    case mjGEOM_CYLINDER:
      return std::hypot(size[0], size[1]);
    case mjGEOM_ELLIPSOID:
      return size.maxCoeff();
    default:
      return size.norm();
  }
}

/// Round geoms stay round. A sphere is scaled by the median of the factors along its axes: the
/// wheel's factor when a wheel grows, 1 when a leg does. The radius of a capsule or cylinder is
/// scaled by the factor nearer 1.
void stretch_size(mjModel& mj, int geom, const Stretch& stretch) {
  const int type = mj.geom_type[geom];
  if (type == mjGEOM_MESH || type == mjGEOM_HFIELD || type == mjGEOM_PLANE) return;
  const Matrix3d axes = axes_at(mj.geom_quat, geom);
  Vector3d factor;
  for (int i = 0; i < 3; ++i) factor[i] = stretch.along(axes.col(i));
  if (type == mjGEOM_SPHERE) {
    std::sort(factor.begin(), factor.end());
    factor[0] = factor[1];
  } else if (type == mjGEOM_CAPSULE || type == mjGEOM_CYLINDER) {
    if (std::abs(factor[1] - 1.0) < std::abs(factor[0] - 1.0)) factor[0] = factor[1];
    factor[1] = factor[2];
  }
  const Vector3d size = row(mj.geom_size, geom).cwiseProduct(factor);
  row(mj.geom_size, geom) = size;
  mj.geom_rbound[geom] = bounding_radius(type, size);
}

/// Stretches a body with the geoms and sites that are fixed to it.
void stretch_body(mjModel& mj, int body, const Stretch& stretch) {
  row(mj.body_ipos, body) = stretch(row(mj.body_ipos, body));
  stretch_inertia(mj, body, stretch);
  mj.body_sameframe[body] = 0;
  for (int geom = 0; geom < mj.ngeom; ++geom) {
    if (mj.geom_bodyid[geom] != body) continue;
    row(mj.geom_pos, geom) = stretch(row(mj.geom_pos, geom));
    stretch_size(mj, geom, stretch);
    mj.geom_sameframe[geom] = 0;
  }
  for (int site = 0; site < mj.nsite; ++site) {
    if (mj.site_bodyid[site] != body) continue;
    row(mj.site_pos, site) = stretch(row(mj.site_pos, site));
    mj.site_sameframe[site] = 0;
  }
}

/// Scales a link between the joint that moves it and the next joint.
void scale_link(RobotModel& robot, std::size_t servo, double factor) {
  mjModel& mj = *robot.mj;
  const int joint = robot.joint[servo];
  const int next = robot.joint[servo + 1];
  const int body = mj.jnt_bodyid[joint];
  const int child = mj.jnt_bodyid[next];
  if (mj.body_parentid[child] != body) {
    throw InputError(fmt::format("expected the body that '{}' moves on the one that '{}' does",
                                 servo_names[servo + 1], servo_names[servo]));
  }
  const Vector3d pivot = row(mj.jnt_pos, joint);
  const Vector3d axis = row(mj.jnt_axis, joint);
  const Vector3d child_position = row(mj.body_pos, child);
  const Vector3d end = child_position + axes_at(mj.body_quat, child) * row(mj.jnt_pos, next);
  const Vector3d lever = end - pivot;
  const Vector3d length = lever - lever.dot(axis) * axis;
  const Stretch stretch = along(length.normalized(), factor, pivot);
  stretch_body(mj, body, stretch);
  row(mj.body_pos, child) = child_position + stretch(end) - end;
}

}  // namespace

void scale_mass(mjModel& mj, double factor) {
  for (int body = 1; body < mj.nbody; ++body) {
    mj.body_mass[body] *= factor;
    for (int axis = 0; axis < 3; ++axis) mj.body_inertia[3 * body + axis] *= factor;
  }
}

void scale_wheels(RobotModel& robot, double factor) {
  mjModel& mj = *robot.mj;
  for (const Servo wheel : wheel_servos) {
    const int joint = robot.joint[index(wheel)];
    stretch_body(mj, mj.jnt_bodyid[joint],
                 across(row(mj.jnt_axis, joint), factor, row(mj.jnt_pos, joint)));
  }
  robot.wheel_radius *= factor;
}

void scale_leg(RobotModel& robot, std::size_t leg, double factor) {
  const std::size_t hip = index(leg == 0 ? Servo::left_hip : Servo::right_hip);
  if (robot.has(hip)) scale_link(robot, hip, factor);
  scale_link(robot, hip + 1, factor);
}

void shift_mass(mjModel& mj, int body, const Eigen::Vector3d& offset) {
  row(mj.body_ipos, body) += offset;
  mj.body_sameframe[body] = 0;
  for (int geom = 0; geom < mj.ngeom; ++geom) {
    if (mj.geom_bodyid[geom] == body) mj.geom_sameframe[geom] = 0;
  }
}

void recompute(mjModel& mj) {
  const MjDataPtr data = make_data(mj);
  // Rendering uses the scene's fixed size (models/scene_mjcf.hpp), not a recomputed one.
  const mjStatistic scene = mj.stat;
  // MuJoCo would close loops in the pose of the file, which may have them open.
  const std::vector<mjtNum> anchors(mj.eq_data, mj.eq_data + mjNEQDATA * mj.neq);
  mj_setConst(&mj, data.get());
  std::copy(anchors.begin(), anchors.end(), mj.eq_data);
  mj.stat.extent = scene.extent;
  std::copy_n(scene.center, 3, mj.stat.center);
}

}  // namespace touchdown::models
