#include "estimator/force/linkage.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/LU>
#include <Eigen/QR>

namespace touchdown {

namespace {

using Eigen::Vector2d;

/// Turns about +y, seen as (x, z).
Vector2d turned(double angle, const Vector2d& v) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {c * v.x() + s * v.y(), c * v.y() - s * v.x()};
}

/// The columns of a matrix for some hinges.
LinkageMatrix columns(const LinkageMatrix& matrix, std::span<const int> hinges) {
  LinkageMatrix chosen(matrix.rows(), static_cast<Eigen::Index>(hinges.size()));
  for (Eigen::Index i = 0; i < chosen.cols(); ++i) {
    chosen.col(i) = matrix.col(hinges[static_cast<std::size_t>(i)]);
  }
  return chosen;
}

/// Some hinges of a leg.
struct SomeHinges {
  std::array<int, most_hinges> number = {};
  std::size_t count = 0;
  std::span<const int> all() const { return std::span(number).first(count); }
};

/// All hinges without the kept ones.
SomeHinges others(const Linkage& linkage, std::span<const int> kept) {
  SomeHinges free;
  for (int i = 0; i < linkage.size(); ++i) {
    if (std::find(kept.begin(), kept.end(), i) == kept.end()) free.number.at(free.count++) = i;
  }
  return free;
}

bool close(const Linkage& linkage, std::span<const int> free, LinkageVector& q) {
  constexpr int most_steps = 20;
  constexpr double closed = 1e-10;  // m
  constexpr double longest = 0.5;   // rad
  for (int step = 0; step < most_steps; ++step) {
    const LinkagePose pose(linkage, q);
    const LinkageVector gaps = pose.gaps();
    if (gaps.lpNorm<Eigen::Infinity>() < closed) return true;
    const LinkageMatrix by_free = columns(pose.gaps_by_hinge(), free);
    LinkageVector change = -by_free.colPivHouseholderQr().solve(gaps);
    change *= std::min(1.0, longest / change.lpNorm<Eigen::Infinity>());
    for (std::size_t i = 0; i < free.size(); ++i) {
      q[free[i]] += change[static_cast<Eigen::Index>(i)];
    }
  }
  return false;
}

/// Orthonormal motions of the hinges that keep the loops closed, as columns.
LinkageMatrix free_motions(const Linkage& linkage, const LinkageVector& q) {
  constexpr double none = 1e-4;  // m/rad
  const LinkageMatrix rows = LinkagePose(linkage, q).gaps_by_hinge();
  const Eigen::ColPivHouseholderQR<LinkageMatrix> qr(rows.transpose());
  const Eigen::Index taken = (qr.matrixR().diagonal().array().abs() > none).count();
  return LinkageMatrix(qr.householderQ()).rightCols(linkage.size() - taken);
}

/// The smallest singular value of a square matrix of one or two rows.
double smallest_singular_value(const LinkageMatrix& m) {
  if (m.rows() == 1) return std::abs(m(0, 0));
  const double determinant = m(0, 0) * m(1, 1) - m(0, 1) * m(1, 0);
  const double half = 0.5 * m.squaredNorm();
  return std::abs(determinant) /
         std::sqrt(half + std::sqrt(std::max(0.0, half * half - determinant * determinant)));
}

}  // namespace

LinkagePose::LinkagePose(const Linkage& linkage, const LinkageVector& q) : linkage_(linkage) {
  for (std::size_t i = 0; i < linkage.hinges.size(); ++i) {
    const Linkage::Hinge& hinge = linkage.hinges[i];
    const double above =
        hinge.above < 0 ? 0.0 : frames_[static_cast<std::size_t>(hinge.above)].angle;
    frames_[i] = {above + hinge.sign * (q[static_cast<Eigen::Index>(i)] - hinge.reference),
                  place({hinge.above, hinge.place})};
  }
}

Vector2d LinkagePose::place(const Linkage::Point& point) const {
  if (point.hinge < 0) return point.place;
  const auto hinge = static_cast<std::size_t>(point.hinge);
  return frames_[hinge].place +
         turned(frames_[hinge].angle, point.place - linkage_.hinges[hinge].place);
}

LinkageRows LinkagePose::jacobian(const Linkage::Point& point) const {
  LinkageRows rows = LinkageRows::Zero(2, linkage_.size());
  const Vector2d end = place(point);
  for (int hinge = point.hinge; hinge >= 0;) {
    const auto i = static_cast<std::size_t>(hinge);
    const Vector2d arm = end - frames_[i].place;
    rows.col(hinge) = linkage_.hinges[i].sign * Vector2d(arm.y(), -arm.x());
    hinge = linkage_.hinges[i].above;
  }
  return rows;
}

LinkageVector LinkagePose::gaps() const {
  LinkageVector gaps(2 * static_cast<Eigen::Index>(linkage_.loops.size()));
  Eigen::Index row = 0;
  for (const Linkage::Loop& loop : linkage_.loops) {
    gaps.segment<2>(row) = place(loop.first) - place(loop.second);
    row += 2;
  }
  return gaps;
}

LinkageMatrix LinkagePose::gaps_by_hinge() const {
  LinkageMatrix rows(2 * static_cast<Eigen::Index>(linkage_.loops.size()), linkage_.size());
  Eigen::Index row = 0;
  for (const Linkage::Loop& loop : linkage_.loops) {
    rows.middleRows<2>(row) = jacobian(loop.first) - jacobian(loop.second);
    row += 2;
  }
  return rows;
}

bool move_linkage(const Linkage& linkage, std::span<const int> kept, std::span<const double> angle,
                  LinkageVector& q) {
  constexpr double longest = 0.2;  // rad
  double way = 0.0;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    way = std::max(way, std::abs(angle[i] - q[kept[i]]));
  }
  constexpr double farthest = 1e3;  // rad; also refuses NaN
  if (!(way < farthest)) return false;
  const SomeHinges free = others(linkage, kept);
  LinkageVector moved = q;
  for (int left = 1 + static_cast<int>(way / longest); left > 0; --left) {
    for (std::size_t i = 0; i < kept.size(); ++i) {
      moved[kept[i]] += (angle[i] - moved[kept[i]]) / left;
    }
    if (!close(linkage, free.all(), moved)) return false;
  }
  q = moved;
  return true;
}

bool move_virtual_leg(const Linkage& linkage, double hip, double knee, LinkageVector& q) {
  constexpr std::array<int, 2> both = {0, 1};
  const std::array<double, 2> angle = {hip, knee};
  const std::size_t given = linkage.motors.size();
  return move_linkage(linkage, std::span(both).first(given), std::span(angle).first(given), q);
}

MotorMap::MotorMap(const Linkage& linkage, const LinkageVector& q) {
  const LinkagePose pose(linkage, q);
  const SomeHinges passive = others(linkage, linkage.motors);
  const LinkageMatrix loops = pose.gaps_by_hinge();
  const LinkageMatrix follows =
      -columns(loops, passive.all()).colPivHouseholderQr().solve(columns(loops, linkage.motors));
  const auto motors = static_cast<Eigen::Index>(linkage.motors.size());
  all = LinkageMatrix::Zero(linkage.size(), motors);
  for (std::size_t i = 0; i < passive.count; ++i) {
    all.row(passive.number.at(i)) = follows.row(static_cast<Eigen::Index>(i));
  }
  for (Eigen::Index i = 0; i < motors; ++i) {
    all(linkage.motors[static_cast<std::size_t>(i)], i) = 1.0;
  }
  leg = all.topRows<2>();
  branch = LinkageRows::Zero(2, motors);
  for (const Linkage::Mass& body : linkage.branch) {
    branch += body.mass * pose.jacobian(body.centre) * all;
  }
  lift = pose.jacobian(linkage.axle).row(1).head<2>();
}

LinkageVector MotorMap::motor_rates(const Vector2d& leg_rates) const {
  return leg.colPivHouseholderQr().solve(leg_rates);
}

LinkageVector MotorMap::motor_torques(const Vector2d& leg_torques) const {
  return leg.transpose() * leg_torques;
}

Vector2d MotorMap::leg_torques(const LinkageVector& motor_torques,
                               const Vector2d& specific_force) const {
  const LinkageVector pressing = motor_torques - branch.transpose() * specific_force;
  if (leg.cols() == 1) return lift * (pressing[0] / leg.col(0).dot(lift));
  return Eigen::Matrix2d(leg).inverse().transpose() * Vector2d(pressing);
}

int mobility(const Linkage& linkage, const LinkageVector& q) {
  return static_cast<int>(free_motions(linkage, q).cols());
}

bool is_regular(const Linkage& linkage, const LinkageVector& q) {
  constexpr double singular = 0.02;
  const LinkageMatrix motions = free_motions(linkage, q);
  const auto motors = static_cast<Eigen::Index>(linkage.motors.size());
  if (motions.cols() != motors) return false;
  LinkageMatrix of_motors(motors, motors);
  for (Eigen::Index i = 0; i < motors; ++i) {
    of_motors.row(i) = motions.row(linkage.motors[static_cast<std::size_t>(i)]);
  }
  // One motor moves hip and knee in one direction.
  const double of_leg =
      motors == 1 ? motions.topRows<2>().norm() : smallest_singular_value(motions.topRows<2>());
  return smallest_singular_value(of_motors) > singular && of_leg > singular;
}

}  // namespace touchdown
