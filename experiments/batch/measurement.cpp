#include "experiments/batch/measurement.hpp"

#include <cmath>
#include <utility>

#include "estimator/bayes/config.hpp"

namespace touchdown::experiments {

BatchedMeasurement::BatchedMeasurement(MeasurementModel model, const BayesFilterConfig& config,
                                       std::span<const BatchNoise> levels)
    : model_(std::move(model), config.measurement),
      config_(config.measurement),
      follows_noise_(config.measurement.noise.is_followed),
      noise_levels_(config.measurement, config.sample_rate),
      knee_noise_(noise_levels_.estimate, noise_levels_.warm_up, levels.size()),
      wheel_noise_(knee_noise_),
      gain_(low_pass_gain(config.measurement.torque.low_pass, 1.0 / config.sample_rate)) {
  check_measurement_config(config.measurement, config.threshold);
  check_levels(levels);
  for (const BatchNoise& level : levels) {
    knee_sigma_.push_back(level.knee_torque);
    wheel_sigma_.push_back(level.wheel_torque);
  }
  for (auto* noisy : {&noisy_knee_, &noisy_wheel_}) {
    noisy->fill(std::vector<double>(levels.size(), 0.0));
  }
  for (Leg& leg : leg_) {
    for (auto* column : {&leg.knee, &leg.wheel, &leg.knee_weight, &leg.wheel_weight, &leg.contact,
                         &leg.no_contact, &leg.p_measurement}) {
      column->resize(levels.size());
    }
    leg.cell.resize(levels.size());
  }
}

void BatchedMeasurement::estimate_noise(const Signals& clean, const NoiseStep& draws) noexcept {
  if (!follows_noise_) return;
  for (std::size_t side = 0; side < 2; ++side) {
    const LegSignals& leg = clean.leg[side];
    add_noise(leg.knee.torque, draws.torque[side].knee, knee_sigma_, noisy_knee_[side]);
    add_noise(leg.wheel.torque, draws.torque[side].wheel, wheel_sigma_, noisy_wheel_[side]);
  }
  knee_noise_.update(noisy_knee_);
  wheel_noise_.update(noisy_wheel_);
}

/// Eq. (4) of one leg, and the position of its torques on the fitted grid.
void BatchedMeasurement::filter_torques(Leg& leg, const LegSignals& clean, const TorqueSample& draw,
                                        double mirror, double gain) const noexcept {
  const std::size_t count = knee_sigma_.size();
  const MeasurementModel& model = model_.fitted();
  const bool absolute = config_.torque.sign == TorqueSign::absolute;
  const double* const knee_sigma = knee_sigma_.data();
  const double* const wheel_sigma = wheel_sigma_.data();
  double* const knee = leg.knee.data();
  double* const wheel = leg.wheel.data();
  int* const cell = leg.cell.data();
  double* const knee_weight = leg.knee_weight.data();
  double* const wheel_weight = leg.wheel_weight.data();
  // The arrays do not overlap, which the compiler cannot know.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC ivdep
#endif
  for (std::size_t i = 0; i < count; ++i) {
    const double noisy_knee = clean.knee.torque + knee_sigma[i] * draw.knee;
    const double noisy_wheel = clean.wheel.torque + wheel_sigma[i] * draw.wheel;
    knee[i] += gain * (mirror * noisy_knee - knee[i]);
    wheel[i] += gain * (mirror * noisy_wheel - wheel[i]);
    const GridPosition position = model.place(
        {absolute ? std::abs(knee[i]) : knee[i], absolute ? std::abs(wheel[i]) : wheel[i]});
    cell[i] = position.cell;
    knee_weight[i] = position.knee_weight;
    wheel_weight[i] = position.wheel_weight;
  }
}

/// Eq. (6) of one leg.
void BatchedMeasurement::look_up(Leg& leg) const noexcept {
  const MeasurementModel& fitted = model_.fitted();
  const bool absolute = config_.torque.sign == TorqueSign::absolute;
  for (std::size_t i = 0; i < knee_sigma_.size(); ++i) {
    const std::size_t level =
        follows_noise_ ? noise_levels_.model(knee_noise_.level(i), wheel_noise_.level(i)) : 0;
    Likelihoods p;
    if (level == 0) {
      p = fitted.at({leg.cell[i], leg.knee_weight[i], leg.wheel_weight[i]});
    } else {
      const TorqueSample m = {leg.knee[i], leg.wheel[i]};
      p = model_.at(level)(absolute ? TorqueSample{std::abs(m.knee), std::abs(m.wheel)} : m);
    }
    leg.contact[i] = p.contact + config_.contact_floor;
    leg.no_contact[i] = p.no_contact + config_.no_contact_floor;
  }
}

void BatchedMeasurement::observe(const Signals& clean, const NoiseStep& draws) noexcept {
  const double gain = started_ ? gain_ : 1.0;
  started_ = true;
  estimate_noise(clean, draws);
  for (std::size_t side = 0; side < 2; ++side) {
    Leg& leg = leg_[side];
    filter_torques(leg, clean.leg[side], draws.torque[side], side == 0 ? 1.0 : -1.0, gain);
    look_up(leg);
  }
}

void BatchedMeasurement::update(const Signals& clean, const NoiseStep& draws) noexcept {
  observe(clean, draws);
  for (Leg& leg : leg_) {
    for (std::size_t i = 0; i < knee_sigma_.size(); ++i) {
      leg.p_measurement[i] = measurement_probability({leg.contact[i], leg.no_contact[i]});
    }
  }
}

}  // namespace touchdown::experiments
