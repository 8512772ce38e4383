#include "estimator/bayes/filter.hpp"

#include <utility>

namespace touchdown {
BayesFilter::BayesFilter(MeasurementModel model, const BayesFilterConfig& config)
    : config_(config),
      model_(std::move(model), config.measurement),
      torques_(config.measurement, config.sample_rate),
      transition_(config.transition, config.sample_rate),
      guard_(config.guard, config.sample_rate) {
  check_members(config);
  reset();
}

void BayesFilter::reset() noexcept {
  transition_.reset();
  guard_.reset();
  torques_.reset();
  measurement_ = {};
  bel_ = {};
  belief_ = Belief{};
  apply_threshold(belief_, config_.threshold);
}

const Belief& BayesFilter::estimate(const Signals& signals) noexcept {
  const SignalGuard::Verdict verdict = guard_.check(signals.time, signals.vertical_acceleration);
  belief_.status = verdict.status;
  if (verdict.restart) {
    transition_.reset();
    torques_.reset_signals();
  }
  if (verdict.acceleration_good) {
    transition_.update(signals.vertical_acceleration);  // Eq. (7) to (13)
  }
  const MeasurementModel& model = model_.at(torques_.noise.update(signals, config_.guard));

  for (std::size_t side = 0; side < 2; ++side) {
    ContactState& bel = bel_[side];  // Eq. (1)
    const LegSignals& leg = signals.leg[side];
    const bool torques_good = has_torques(leg, config_.guard);
    const bool measured = torques_good && verdict.acceleration_good;
    if (!torques_good) belief_.status = SignalStatus::invalid;
    if (verdict.restart || !measured) {
      bel.contact = guard_.relaxed(bel.contact, verdict.elapsed);
      bel.no_contact = 1.0 - bel.contact;
    }
    if (measured) {
      const TorqueSample torque = torques_.leg[side].update(leg);             // Eq. (4)
      const Likelihoods likelihood = model_.likelihoods(model, torque);       // Eq. (5) and (6)
      const ContactState predicted = predict(transition_.transition(), bel);  // Eq. (2a)
      bel = correct(likelihood, predicted, bel);                              // Eq. (2b) and (3)
      measurement_[side] = {torque, likelihood, predicted.contact};
    }
    belief_.wheel[side].p_contact = bel.contact;
  }
  apply_threshold(belief_, config_.threshold);
  return belief_;
}

Evidence BayesFilter::evidence() const noexcept {
  const Transition& t = transition_.transition();
  return {{measurement_[0].evidence(), measurement_[1].evidence()},
          {t.power, t.median_frequency, t.filtered_median_frequency, t.p_switch, t.p_landing,
           t.contact_to_air, t.air_to_contact}};
}

}  // namespace touchdown
