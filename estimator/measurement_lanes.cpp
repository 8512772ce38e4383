#include "estimator/measurement_lanes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "estimator/robot_belief.hpp"

namespace touchdown {

MeasurementLanes::MeasurementLanes(MeasurementModel model, const BayesFilterConfig& config,
                                   std::span<const NoiseLevel> levels)
    : model_(std::move(model)),
      config_(config.measurement),
      gain_(low_pass_gain(config.measurement.torque.low_pass, 1.0 / config.sample_rate)) {
  check_measurement_config(config.measurement, config.threshold);
  if (levels.empty()) {
    throw InputError("a sweep needs at least one noise level");
  }
  for (const NoiseLevel& level : levels) {
    for (const double sigma : {level.knee_torque, level.wheel_torque}) {
      if (!(std::isfinite(sigma) && sigma >= 0.0)) {
        throw InputError("a torque noise level must be finite and not negative (N·m)");
      }
    }
    knee_sigma_.push_back(level.knee_torque);
    wheel_sigma_.push_back(level.wheel_torque);
  }
  for (Leg& leg : leg_) {
    for (auto* column :
         {&leg.knee, &leg.wheel, &leg.contact, &leg.no_contact, &leg.p_measurement}) {
      column->resize(levels.size());
    }
  }
  reset();
}

void MeasurementLanes::reset() noexcept {
  started_ = false;
  for (Leg& leg : leg_) {
    std::fill(leg.p_measurement.begin(), leg.p_measurement.end(), 0.5);
  }
}

void MeasurementLanes::update(const Signals& clean, const NoiseDraws& draws) noexcept {
  const std::size_t count = knee_sigma_.size();
  const double gain = started_ ? gain_ : 1.0;
  started_ = true;
  const bool absolute = config_.torque.sign == TorqueSign::absolute;
  for (std::size_t side = 0; side < 2; ++side) {
    Leg& leg = leg_[side];
    const double mirror = side == 0 ? 1.0 : -1.0;
    const double knee = clean.leg[side].knee.torque;
    const double wheel = clean.leg[side].wheel.torque;
    const TorqueSample z = draws.torque[side];
    for (std::size_t i = 0; i < count; ++i) {
      const double noisy_knee = knee + knee_sigma_[i] * z.knee;
      const double noisy_wheel = wheel + wheel_sigma_[i] * z.wheel;
      leg.knee[i] += gain * (mirror * noisy_knee - leg.knee[i]);
      leg.wheel[i] += gain * (mirror * noisy_wheel - leg.wheel[i]);
    }
    for (std::size_t i = 0; i < count; ++i) {
      const TorqueSample m = absolute ? TorqueSample{std::abs(leg.knee[i]), std::abs(leg.wheel[i])}
                                      : TorqueSample{leg.knee[i], leg.wheel[i]};
      const Likelihoods p = model_(m);
      leg.contact[i] = p.contact + config_.contact_floor;
      leg.no_contact[i] = p.no_contact + config_.no_contact_floor;
    }
    for (std::size_t i = 0; i < count; ++i) {
      const double sum = leg.contact[i] + leg.no_contact[i];
      leg.p_measurement[i] = sum > 0.0 ? leg.contact[i] / sum : 0.5;
    }
  }
}

}  // namespace touchdown
