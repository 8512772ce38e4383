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
      noise_(config.measurement, config.sample_rate),
      guard_(without_accelerometer(config.guard), config.sample_rate),
      torque_{TorqueChannel(config.measurement.torque, Side::left, config.sample_rate),
              TorqueChannel(config.measurement.torque, Side::right, config.sample_rate)} {
  check_measurement_config(config.measurement, config.threshold);
  reset();
}

void MeasurementOnly::reset() noexcept {
  guard_.reset();
  noise_.reset();
  for (TorqueChannel& torque : torque_) torque.reset();
  measurement_ = {};
  belief_ = Belief{};
  apply_threshold(belief_, config_.threshold);
}

const Belief& MeasurementOnly::estimate(const Signals& signals) noexcept {
  const SignalGuard::Verdict verdict = guard_.check(signals.time, 0.0);
  belief_.status = verdict.status;
  if (verdict.restart) noise_.reset_signals();
  const MeasurementModel& model = model_.at(noise_.update(signals, config_.guard));
  for (std::size_t side = 0; side < 2; ++side) {
    if (verdict.restart) torque_[side].reset();
    const LegSignals& leg = signals.leg[side];
    WheelBelief& wheel = belief_.wheel[side];
    if (!has_torques(leg, config_.guard)) {
      belief_.status = SignalStatus::invalid;
      wheel.p_contact = guard_.relaxed(wheel.p_contact, verdict.elapsed);
      continue;
    }
    MeasurementDiagnostics& m = measurement_[side];
    m.torque = torque_[side].update(leg);  // Eq. (4)
    m.likelihood = model(m.torque);        // Eq. (6)
    m.likelihood.contact += config_.measurement.contact_floor;
    m.likelihood.no_contact += config_.measurement.no_contact_floor;
    wheel.p_contact = m.p_measurement();  // Eq. (14)
  }
  apply_threshold(belief_, config_.threshold);
  return belief_;
}

}  // namespace touchdown
