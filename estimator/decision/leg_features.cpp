#include "estimator/decision/leg_features.hpp"

#include <algorithm>
#include <cmath>

#include "estimator/force/servo_law.hpp"

namespace touchdown {

namespace {

constexpr double unobservable_load = 15.0;  // N
constexpr double least_area = 0.003;        // m²
constexpr double least_servo_area = 0.001;  // m²: tracking errors are more precise than torques
constexpr double area_of_noise = 0.004;     // m² for each N·m
constexpr double largest_load = 200.0;      // N: four times Upkie's weight
constexpr double largest_feature = 1e4;     // of the others, so that floats hold them

/// Clamps the value to ± `largest`; NaN becomes 0.
double within(double value, double largest) noexcept {
  return std::isnan(value) ? 0.0 : std::clamp(value, -largest, largest);
}

}  // namespace

LegFeatureExtractor::LegFeatureExtractor(const DecisionConfig& config, bool mirrored)
    : geometry_(config.geometry),
      guard_(config.guard),
      mass_ratio_(mass_ratio(config.geometry)),
      mirrored_(mirrored) {
  const double steps = std::clamp(std::round(config.difference * config.sample_rate), 1.0, 1e4);
  velocities_.resize(static_cast<std::size_t>(steps));
  rate_ = config.sample_rate / steps;
}

// Inline, because position-independent code calls all other functions.
inline double LegFeatureExtractor::load_of(const FootJacobian& foot, double force_times_area,
                                           double least, double torque_noise) const noexcept {
  const double area = foot.determinant();
  const double noisy_area = area_of_noise * torque_noise;
  const double damping = least * least + noisy_area * noisy_area;
  const double load = (area * mass_ratio_ * force_times_area + damping * unobservable_load) /
                      (area * area + damping);
  return within(load, largest_load);
}

ServoLoadFeature LegFeatureExtractor::servo_load(const LegSignals& leg, const LegTargets& target,
                                                 const FootJacobian& foot,
                                                 double vertical_acceleration) const noexcept {
  const ServoLoad load =
      touchdown::servo_load(geometry_, foot, leg, target, mirrored_, vertical_acceleration, guard_);
  if (!std::isfinite(load.force_times_determinant)) return {unobservable_load, true};
  return {load_of(foot, load.force_times_determinant, least_servo_area,
                  mass_ratio_ * load.torque_noise),
          false};
}

LegFeatures LegFeatureExtractor::update(const LegSignals& leg, const FootJacobian& foot,
                                        double vertical_acceleration,
                                        double torque_noise) noexcept {
  const double sign = mirrored_ ? -1.0 : 1.0;
  const std::array<double, 2> now = {sign * leg.wheel.velocity,
                                     within(axle_velocity(foot, leg, mirrored_), largest_feature)};
  const std::array<double, 2> before = count_ < velocities_.size() ? now : velocities_[next_];
  velocities_[next_] = now;
  next_ = next_ + 1 == velocities_.size() ? 0 : next_ + 1;
  count_ = std::min(count_ + 1, velocities_.size());

  const double load = load_of(
      foot,
      vertical_force_times_determinant(geometry_, foot, leg, mirrored_, vertical_acceleration),
      least_area, torque_noise);
  const double reaction =
      sign * leg.wheel.torque - geometry_.wheel_inertia * rate_ * (now[0] - before[0]);
  return {load, within(mass_ratio_ * reaction, largest_feature), now[1],
          within(vertical_acceleration + rate_ * (now[1] - before[1]), largest_feature)};
}

}  // namespace touchdown
