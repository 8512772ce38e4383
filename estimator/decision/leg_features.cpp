#include "estimator/decision/leg_features.hpp"

#include <algorithm>
#include <cmath>

namespace touchdown {

namespace {

constexpr double unobservable_load = 15.0;  // N
constexpr double least_area = 0.003;        // m²
constexpr double area_of_noise = 0.004;     // m² for each N·m
constexpr double largest_load = 200.0;      // N: four times Upkie's weight
constexpr double largest_feature = 1e4;     // of the others, so that floats hold them

/// Clamps the value to ± `largest`; NaN becomes 0.
double within(double value, double largest) noexcept {
  return std::isnan(value) ? 0.0 : std::clamp(value, -largest, largest);
}

}  // namespace

LegFeatureExtractor::LegFeatureExtractor(const DecisionConfig& config, bool mirrored)
    : geometry_(config.geometry), mass_ratio_(mass_ratio(config.geometry)), mirrored_(mirrored) {
  const double steps = std::clamp(std::round(config.difference * config.sample_rate), 1.0, 1e4);
  velocities_.resize(static_cast<std::size_t>(steps));
  rate_ = config.sample_rate / steps;
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

  const double area = foot.determinant();
  const double noisy_area = area_of_noise * torque_noise;
  const double damping = least_area * least_area + noisy_area * noisy_area;
  const double force_times_area =
      vertical_force_times_determinant(geometry_, foot, leg, mirrored_, vertical_acceleration);
  const double load = (area * mass_ratio_ * force_times_area + damping * unobservable_load) /
                      (area * area + damping);
  const double reaction =
      sign * leg.wheel.torque - geometry_.wheel_inertia * rate_ * (now[0] - before[0]);
  return {within(load, largest_load), within(mass_ratio_ * reaction, largest_feature), now[1],
          within(vertical_acceleration + rate_ * (now[1] - before[1]), largest_feature)};
}

}  // namespace touchdown
