#pragma once

#include <array>

#include <Eigen/Core>

#include "estimator/force/linkage.hpp"
#include "estimator/models/arrays.hpp"
#include "estimator/signals.hpp"

namespace touchdown {

/// A leg with closed loops, and how its motors count. Theirs, with the sign and then the zero, is
/// the angle of the linkage's hinge.
struct MotorLeg {
  Linkage linkage;
  std::array<double, 2> sign = {1.0, 1.0};
  std::array<double, 2> zero = {};  ///< rad
};

/// Turns what motors of closed legs report into hips and knees, step by step.
class ClosedLegs {
 public:
  ClosedLegs() = default;
  /// Left, right.
  explicit ClosedLegs(std::array<MotorLeg, 2> legs);

  const std::array<MotorLeg, 2>& legs() const noexcept { return legs_; }
  void reset() noexcept;

  /// Replaces motors by hips and knees. The hip's place has a leg's first motor, the knee's the
  /// second one, if there is one. `proper_acceleration`: of the IMU, x back, y left, z down; only
  /// torques need it. What does not follow from these numbers, or from loops that cannot close, is
  /// NaN. Nothing is allocated.
  void convert(std::array<LegSignals, 2>& signals,
               const Eigen::Vector3d& proper_acceleration) noexcept;

 private:
  std::array<MotorLeg, 2> legs_;
  std::array<LinkageVector, 2> angles_;  ///< of all hinges at the last step (rad)
};

/// Closed legs as the arrays of a file, which `touchdown check ROBOT --legs FILE` writes.
ModelArrays arrays_of(const ClosedLegs& legs);
/// The inverse. Errors: `InputError` for arrays that are missing or are no linkage.
ClosedLegs closed_legs_of(const ModelArrays& arrays);

}  // namespace touchdown
