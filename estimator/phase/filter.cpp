#include "estimator/phase/filter.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace touchdown {

namespace {

std::shared_ptr<const PhaseModel> shared_model(PhaseModel&& model) {
  check_phase_model(model);
  return std::make_shared<const PhaseModel>(std::move(model));
}

}  // namespace

PhaseFilter::PhaseFilter(PhaseModel model, const PhaseFilterConfig& config)
    : PhaseFilter(shared_model(std::move(model)), config) {}

PhaseFilter::PhaseFilter(std::shared_ptr<const PhaseModel> model, const PhaseFilterConfig& config)
    : config_(config),
      prepared_(std::move(model), config),
      guard_(config.guard, config.sample_rate) {
  reset();
}

void PhaseFilter::reset() noexcept {
  guard_.reset();
  prepared_.knee_noise.reset();
  prepared_.wheel_noise.reset();
  prepared_.acceleration_noise.reset();
  for (std::size_t k = 0; k < phase_count; ++k) alpha_[k].setConstant(PhaseRecursion::prior[k]);
  belief_ = Belief{};
  for (WheelBelief& wheel : belief_.wheel) wheel.contact = true;
  apply_threshold();
}

PhaseProbabilities PhaseFilter::phases() const noexcept {
  PhaseProbabilities p{};
  for (std::size_t k = 0; k < phase_count; ++k) p[k] = alpha_[k][0];
  return p;
}

PhaseNoise PhaseFilter::noise() const noexcept {
  return config_.noise.value_or(PhaseNoise{prepared_.knee_noise.sigma(),
                                           prepared_.wheel_noise.sigma(),
                                           prepared_.acceleration_noise.sigma()});
}

const Belief& PhaseFilter::estimate(const Signals& signals) noexcept {
  const SignalGuard::Verdict verdict = guard_.check(signals.time, signals.vertical_acceleration);
  belief_.status = verdict.status;
  std::array<bool, 2> torques_good{};
  for (std::size_t side = 0; side < 2; ++side) {
    const LegSignals& leg = signals.leg[side];
    torques_good[side] = has_torques(leg, config_.guard);
    if (!torques_good[side]) belief_.status = SignalStatus::invalid;
  }
  const bool usable = verdict.acceleration_good && (torques_good[0] || torques_good[1]);
  if (verdict.restart) {
    prepared_.knee_noise.reset_signals();
    prepared_.wheel_noise.reset_signals();
    prepared_.acceleration_noise.reset_signals();
  }
  if (verdict.restart || !usable) reset_memory(verdict.elapsed);
  if (!usable) {
    apply_threshold();
    return belief_;
  }
  if (!config_.noise) estimate_noise(signals, verdict.acceleration_good);

  const PhaseNoiseLevel knee_level =
      prepared_.knee_levels[config_.noise ? 0 : prepared_.knee_noise.level()];
  const PhaseNoiseLevel wheel_level =
      prepared_.wheel_levels[config_.noise ? 0 : prepared_.wheel_noise.level()];
  const PhaseNoiseLevel acceleration_level =
      prepared_.acceleration_levels[config_.noise ? 0 : prepared_.acceleration_noise.level()];
  const auto evidence = [&](std::size_t side) {
    const LegSignals& leg = signals.leg[side];
    const double mirror = side == 0 ? 1.0 : -1.0;
    return torques_good[side] ? prepared_.torque(mirror * leg.knee.torque,
                                                 mirror * leg.wheel.torque, knee_level, wheel_level)
                              : PhaseRow{};
  };
  const PhaseRow legs = legs_row(evidence(0), evidence(1));
  const PhaseRow vertical =
      prepared_.acceleration(signals.vertical_acceleration, acceleration_level);
  PhaseValues<1> log_likelihood;
  for (std::size_t k = 0; k < phase_count; ++k) {
    log_likelihood[k].setConstant(static_cast<double>(legs[k] + vertical[k]));
  }
  prepared_.recursion.predict_and_correct(alpha_, log_likelihood);
  apply_threshold();
  return belief_;
}

/// The belief after `elapsed` seconds without a measurement.
void PhaseFilter::reset_memory(double elapsed) noexcept {
  const double kept = std::exp(-elapsed / config_.guard.relaxation);
  for (std::size_t k = 0; k < phase_count; ++k) {
    alpha_[k] = kept * alpha_[k] + (1.0 - kept) * PhaseRecursion::prior[k];
  }
}

void PhaseFilter::estimate_noise(const Signals& s, bool acceleration_good) noexcept {
  prepared_.knee_noise.update({s.leg[0].knee.torque, s.leg[1].knee.torque});
  prepared_.wheel_noise.update({s.leg[0].wheel.torque, s.leg[1].wheel.torque});
  if (acceleration_good) prepared_.acceleration_noise.update({s.vertical_acceleration});
}

void PhaseFilter::apply_threshold() noexcept {
  const PhaseProbabilities p = phases();
  const double left_only = p[index(Phase::left_only)];
  const double right_only = p[index(Phase::right_only)];
  const double none = p[index(Phase::flight)] + p[index(Phase::held)];
  const auto bounded = [](double x) { return std::clamp(x, 0.0, 1.0); };
  const std::array<double, 2> wheels = wheel_probabilities(alpha_);
  belief_.wheel[0].p_contact = wheels[0];
  belief_.wheel[1].p_contact = wheels[1];
  belief_.p_any_wheel = bounded(1.0 - none);
  belief_.p_both_wheels = bounded(1.0 - (none + left_only + right_only));
  for (WheelBelief& wheel : belief_.wheel) {
    wheel.contact = stays_or_returns(wheel.contact, wheel.p_contact, config_);
  }
}

}  // namespace touchdown
