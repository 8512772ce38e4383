#include "estimator/bayes/filter.hpp"

#include <cmath>
#include <utility>

namespace touchdown {
namespace {

using State = BayesFilter::State;

/// Eq. (2a): bel-bar(S_t) = Σ_S P(S_t | S_t−1 = S) bel(S_t−1). The published matrix's rows do not
/// sum to one, so neither does this pair.
State predict(const Transition& p, const State& bel) noexcept {
  return {p.contact_to_contact * bel.contact + p.air_to_contact * bel.no_contact,
          p.contact_to_air * bel.contact + p.air_to_air * bel.no_contact};
}

/// Eq. (2b) and (3). If every product is zero, the old belief stays.
State correct(const Likelihoods& p, const State& predicted, const State& bel) noexcept {
  const State joint{p.contact * predicted.contact, p.no_contact * predicted.no_contact};
  const double eta = joint.contact + joint.no_contact;
  return eta > 0.0 ? State{joint.contact / eta, joint.no_contact / eta} : bel;
}

}  // namespace

BayesFilter::BayesFilter(MeasurementModel model, const BayesFilterConfig& config)
    : config_(config),
      model_(std::move(model), config.measurement),
      noise_(config.measurement, config.sample_rate),
      transition_(config.transition, config.sample_rate),
      guard_(config.guard, config.sample_rate),
      torque_{TorqueChannel(config.measurement.torque, Side::left, config.sample_rate),
              TorqueChannel(config.measurement.torque, Side::right, config.sample_rate)} {
  check_measurement_config(config.measurement, config.threshold);
  reset();
}

void BayesFilter::reset() noexcept {
  transition_.reset();
  guard_.reset();
  noise_.reset();
  for (TorqueChannel& torque : torque_) torque.reset();
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
    noise_.reset_signals();
    torque_[0].reset();
    torque_[1].reset();
  }
  if (verdict.acceleration_good) {
    transition_.update(signals.vertical_acceleration);  // Eq. (7) to (13)
  }
  const MeasurementModel& model = model_.at(noise_.update(signals, config_.guard));

  for (std::size_t side = 0; side < 2; ++side) {
    State& bel = bel_[side];  // Eq. (1)
    const LegSignals& leg = signals.leg[side];
    const bool torques_good = has_torques(leg, config_.guard);
    const bool measured = torques_good && verdict.acceleration_good;
    if (!torques_good) belief_.status = SignalStatus::invalid;
    if (verdict.restart || !measured) {
      bel.contact = guard_.relaxed(bel.contact, verdict.elapsed);
      bel.no_contact = 1.0 - bel.contact;
    }
    if (measured) {
      MeasurementDiagnostics& m = measurement_[side];
      m.torque = torque_[side].update(leg);  // Eq. (4)
      m.likelihood = model(m.torque);        // Eq. (5) and (6)
      m.likelihood.contact += config_.measurement.contact_floor;
      m.likelihood.no_contact += config_.measurement.no_contact_floor;

      const State predicted = predict(transition_.transition(), bel);  // Eq. (2a)
      bel = correct(m.likelihood, predicted, bel);                     // Eq. (2b) and (3)
      m.p_predicted = predicted.contact;
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
