#include "estimator/bayes/measurement_only.hpp"

#include <utility>

namespace touchdown {
namespace {

SignalGuardConfig without_accelerometer(SignalGuardConfig config) {
  config.frozen_after = 0.0;
  return config;
}

}  // namespace

MeasurementOnly::MeasurementOnly(MeasurementModel model, const BayesFilterConfig& config)
    : config_(config),
      model_(std::move(model), config.measurement),
      torques_(config.measurement, config.sample_rate),
      guard_(without_accelerometer(config.guard), config.sample_rate) {
  check_measurement_config(config.measurement, config.threshold);
  reset();
}

void MeasurementOnly::reset() noexcept {
  guard_.reset();
  torques_.reset();
  measurement_ = {};
  belief_ = Belief{};
  apply_threshold(belief_, config_.threshold);
}

const Belief& MeasurementOnly::estimate(const Signals& signals) noexcept {
  const SignalGuard::Verdict verdict = guard_.check(signals.time, 0.0);
  belief_.status = verdict.status;
  if (verdict.restart) torques_.reset_signals();
  const MeasurementModel& model = model_.at(torques_.noise.update(signals, config_.guard));
  for (std::size_t side = 0; side < 2; ++side) {
    const LegSignals& leg = signals.leg[side];
    WheelBelief& wheel = belief_.wheel[side];
    if (!has_torques(leg, config_.guard)) {
      belief_.status = SignalStatus::invalid;
      wheel.p_contact = guard_.relaxed(wheel.p_contact, verdict.elapsed);
      continue;
    }
    const TorqueSample torque = torques_.leg[side].update(leg);        // Eq. (4)
    measurement_[side] = {torque, model_.likelihoods(model, torque)};  // Eq. (6)
    wheel.p_contact = measurement_[side].p_measurement();              // Eq. (14)
  }
  apply_threshold(belief_, config_.threshold);
  return belief_;
}

}  // namespace touchdown
