#pragma once

#include <array>

#include "estimator/force/leg_geometry.hpp"

namespace touchdown {

struct AxleMotionConfig {
  double sample_rate = 1000.0;  ///< at which `update` is called (Hz)
  LegGeometry geometry = {};
  double leak = 0.3;  ///< time constant with which the torso's velocity decays (s)
};

/// The vertical velocity of each axle, by differential kinematics of the legs. The torso's velocity
/// is a leaky integral of its acceleration. Estimators and their fits use the same one.
class AxleMotion {
 public:
  explicit AxleMotion(const AxleMotionConfig& config) noexcept;

  /// Resets all state: the next step does not follow the previous ones.
  void reset() noexcept;

  /// `acceleration`: upward acceleration of the torso (m/s²), or 0 if it is unknown.
  void update(const Signals& signals, double acceleration) noexcept;

  /// Whether the last step measured this leg.
  [[nodiscard]] bool is_measured(std::size_t side) const noexcept { return is_measured_[side]; }
  /// The last measured velocity, upwards (m/s).
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
