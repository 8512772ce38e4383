#pragma once

#include <array>

#include "estimator/force/leg_geometry.hpp"

namespace touchdown {

struct AxleMotionConfig {
  double sample_rate = 1000.0;  ///< at which `update` is called (Hz)
  LegGeometry geometry = {};
  double leak = 0.3;  ///< time constant with which the torso's velocity is forgotten (s)
};

/// How fast each axle moves up or down: differential kinematics of the legs, on a torso whose
/// velocity is a leaky integral of its acceleration. Alike for those that listen and for what they
/// are fitted to.
class AxleMotion {
 public:
  explicit AxleMotion(const AxleMotionConfig& config) noexcept;

  /// Forgets everything: what comes next does not follow what came.
  void reset() noexcept;

  /// `acceleration`: the torso's, upwards (m/s²), or 0 where it is not known.
  void update(const Signals& signals, double acceleration) noexcept;

  /// Whether the last step had the velocities of this leg.
  [[nodiscard]] bool is_measured(std::size_t side) const noexcept { return is_measured_[side]; }
  /// Upwards (m/s); the last that was measured.
  [[nodiscard]] double velocity(std::size_t side) const noexcept { return velocity_[side]; }

 private:
  LegGeometry geometry_;
  double time_step_;
  double leak_;
  double torso_ = 0.0;  ///< m/s, upwards
  std::array<double, 2> velocity_ = {};
  std::array<bool, 2> is_measured_ = {};
};

}  // namespace touchdown
