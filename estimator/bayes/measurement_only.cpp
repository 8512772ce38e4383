#include "estimator/bayes/measurement_only.hpp"

#include <utility>

namespace touchdown {
MeasurementOnly::MeasurementOnly(MeasurementModel model, BayesFilterConfig config)
    : BayesFilter(std::move(model), [&] {
        config.guard.frozen_after = 0.0;  // there is no accelerometer
        return config;
      }()) {}

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
