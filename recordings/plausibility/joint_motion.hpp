#pragma once

#include <Eigen/Core>

#include "recordings/plausibility/findings.hpp"
#include "recordings/plausibility/window.hpp"

namespace touchdown::recordings {

/// Checks every joint that moves: its reported velocity is the derivative of its position. Units,
/// signs, and the order of joints show.
class JointMotionCheck {
 public:
  void add(const CheckedWindow& window);
  void report(Findings& findings) const;

 private:
  using Matrix = Eigen::Matrix<double, models::servo_count, models::servo_count>;
  using Vector = Eigen::Matrix<double, models::servo_count, 1>;

  int windows_ = 0;
  Matrix products_ = Matrix::Zero();  ///< Σ velocity i · derivative of position j
  Vector velocity_squares_ = Vector::Zero();
  Vector derivative_squares_ = Vector::Zero();
};

}  // namespace touchdown::recordings
