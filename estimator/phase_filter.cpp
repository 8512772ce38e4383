#include "estimator/phase_filter.hpp"

#include <algorithm>
#include <cmath>

namespace touchdown {
namespace {

const PhaseModel& checked(const PhaseModel& model, const PhaseFilterConfig& config) {
  check_phase_filter_config(config);
  check_phase_model(model);
  return model;
}

}  // namespace

PhaseFilter::PhaseFilter(const PhaseModel& model, const PhaseFilterConfig& config)
    : config_(config),
      recursion_(checked(model, config), phase_stride(model.sample_rate, config.sample_rate)),
      torque_(model.torque, phase_exponent(config.torque_exponent,
                                           phase_stride(model.sample_rate, config.sample_rate))),
      acceleration_(model.acceleration,
                    phase_exponent(config.acceleration_exponent,
                                   phase_stride(model.sample_rate, config.sample_rate))),
      guard_(config.guard, config.sample_rate),
      knee_noise_(config.noise_floor.knee_torque,
                  noise_ceiling(model.torque.back().noise.knee, config.noise_floor.knee_torque),
                  config.noise_gain, config.noise_warm_up * config.sample_rate),
      wheel_noise_(config.noise_floor.wheel_torque,
                   noise_ceiling(model.torque.back().noise.wheel, config.noise_floor.wheel_torque),
                   config.noise_gain, config.noise_warm_up * config.sample_rate),
      acceleration_noise_(
          config.noise_floor.acceleration,
          noise_ceiling(model.acceleration.back().noise, config.noise_floor.acceleration),
          config.noise_gain, config.noise_warm_up * config.sample_rate) {
  knee_levels_ = noise_levels(
      torque_, config.noise ? std::vector{config.noise->knee_torque} : knee_noise_.rungs());
  wheel_levels_ = noise_levels(
      torque_, config.noise ? std::vector{config.noise->wheel_torque} : wheel_noise_.rungs());
  acceleration_levels_ =
      noise_levels(acceleration_, config.noise ? std::vector{config.noise->acceleration}
                                               : acceleration_noise_.rungs());
  reset();
}

void PhaseFilter::reset() noexcept {
  guard_.reset();
  knee_noise_.reset();
  wheel_noise_.reset();
  acceleration_noise_.reset();
  alpha_ = {};
  std::copy(PhaseRecursion::prior.begin(), PhaseRecursion::prior.end(), alpha_.begin());
  belief_ = Belief{};
  for (WheelBelief& wheel : belief_.wheel) wheel.contact = true;
  conclude();
}

PhaseProbabilities PhaseFilter::phases() const noexcept {
  PhaseProbabilities p{};
  std::copy_n(alpha_.begin(), phase_count, p.begin());
  return p;
}

PhaseNoise PhaseFilter::noise() const noexcept {
  return config_.noise.value_or(
      PhaseNoise{knee_noise_.sigma(), wheel_noise_.sigma(), acceleration_noise_.sigma()});
}

const Belief& PhaseFilter::update(const Signals& signals) noexcept {
  const SignalGuard::Verdict verdict = guard_.check(signals.time, signals.vertical_acceleration);
  belief_.status = verdict.status;
  std::array<bool, 2> torques_good{};
  for (std::size_t side = 0; side < 2; ++side) {
    const LegSignals& leg = signals.leg[side];
    torques_good[side] = std::isfinite(leg.knee.torque) && std::isfinite(leg.wheel.torque);
    if (!torques_good[side]) belief_.status = SignalStatus::invalid;
  }
  const bool usable = verdict.acceleration_good && (torques_good[0] || torques_good[1]);
  if (verdict.restart) {
    knee_noise_.forget_signals();
    wheel_noise_.forget_signals();
    acceleration_noise_.forget_signals();
  }
  if (verdict.restart || !usable) forget(verdict.elapsed);
  if (!usable) {
    conclude();
    return belief_;
  }
  if (!config_.noise) listen_to_noise(signals, verdict.acceleration_good);

  const PhaseNoiseLevel knee_level = knee_levels_[config_.noise ? 0 : knee_noise_.rung()];
  const PhaseNoiseLevel wheel_level = wheel_levels_[config_.noise ? 0 : wheel_noise_.rung()];
  const PhaseNoiseLevel acceleration_level =
      acceleration_levels_[config_.noise ? 0 : acceleration_noise_.rung()];
  const auto evidence = [&](std::size_t side) {
    const LegSignals& leg = signals.leg[side];
    const double mirror = side == 0 ? 1.0 : -1.0;
    return torques_good[side] ? torque_(mirror * leg.knee.torque, mirror * leg.wheel.torque,
                                        knee_level, wheel_level)
                              : PhaseRow{};
  };
  const PhaseRow left = evidence(0);
  const PhaseRow right = evidence(1);
  const PhaseRow vertical = acceleration_(signals.vertical_acceleration, acceleration_level);

  recursion_.predict_and_correct(alpha_, PhaseRecursion::evidence(left, right, vertical));
  conclude();
  return belief_;
}

/// The belief after `elapsed` seconds without news.
void PhaseFilter::forget(double elapsed) noexcept {
  const double kept = std::exp(-elapsed / config_.guard.relaxation);
  for (std::size_t k = 0; k < phase_count; ++k) {
    alpha_[k] = kept * alpha_[k] + (1.0 - kept) * PhaseRecursion::prior[k];
  }
}

void PhaseFilter::listen_to_noise(const Signals& s, bool acceleration_good) noexcept {
  knee_noise_.update({s.leg[0].knee.torque, s.leg[1].knee.torque});
  wheel_noise_.update({s.leg[0].wheel.torque, s.leg[1].wheel.torque});
  if (acceleration_good) acceleration_noise_.update({s.vertical_acceleration});
}

void PhaseFilter::conclude() noexcept {
  const double left_only = alpha_[index(Phase::left_only)];
  const double right_only = alpha_[index(Phase::right_only)];
  const double none = alpha_[index(Phase::flight)] + alpha_[index(Phase::held)];
  const auto bounded = [](double p) { return std::clamp(p, 0.0, 1.0); };
  const std::array<double, 2> wheels = PhaseRecursion::wheels(alpha_);
  belief_.wheel[0].p_contact = wheels[0];
  belief_.wheel[1].p_contact = wheels[1];
  belief_.p_any_wheel = bounded(1.0 - none);
  belief_.p_both_wheels = bounded(1.0 - (none + left_only + right_only));
  for (WheelBelief& wheel : belief_.wheel) {
    wheel.contact = wheel.contact ? wheel.p_contact >= config_.leave_below
                                  : wheel.p_contact > config_.return_above;
  }
}

}  // namespace touchdown
