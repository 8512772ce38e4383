#include "estimator/force/force_kinematics.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "estimator/low_pass.hpp"

namespace touchdown {

namespace {

/// Whether a joint can have this velocity (rad/s); NaN fails.
bool is_velocity(double velocity) noexcept {
  constexpr double largest = 1e4;
  return std::abs(velocity) <= largest;
}

WheelLoadsConfig loads_of(const ForceKinematicsConfig& config) noexcept {
  return {.sample_rate = config.sample_rate,
          .geometry = config.geometry,
          .low_pass = config.low_pass,
          .largest = config.largest_force,
          .guard = config.guard};
}

bool is_sensible(const WheelState& state) noexcept {
  const auto is_scale = [](double value) { return std::isfinite(value) && value > 0.0; };
  return std::isfinite(state.force_mean) && is_scale(state.force_deviation) &&
         is_scale(state.axle_deviation) && is_scale(state.leaving_rate);
}

double square(double x) noexcept { return x * x; }

/// The part of the log likelihood ratio that does not depend on the observation.
double log_deviation_ratio(const ForceKinematicsModel& model) noexcept {
  const auto log_deviations = [](const WheelState& state) {
    return std::log(state.force_deviation) + std::log(state.axle_deviation);
  };
  return log_deviations(model.air) - log_deviations(model.contact);
}

/// The part that does.
double exponent_ratio(const ForceKinematicsModel& model,
                      const WheelObservation& observation) noexcept {
  const auto [least, most] = std::minmax(model.air.force_mean, model.contact.force_mean);
  const double force = std::clamp(observation.force, least, most);
  const auto exponent = [&](const WheelState& state) {
    return square((force - state.force_mean) / state.force_deviation) +
           square(observation.axle_velocity / state.axle_deviation);
  };
  return 0.5 * (exponent(model.air) - exponent(model.contact));
}

}  // namespace

AxleMotion::AxleMotion(const ForceKinematicsConfig& config) noexcept
    : geometry_(config.geometry),
      time_step_(1.0 / config.sample_rate),
      leak_(exact_low_pass_gain(config.leak, config.sample_rate)) {}

void AxleMotion::reset() noexcept {
  torso_ = 0.0;
  velocity_ = {};
  is_measured_ = {};
}

void AxleMotion::update(const Signals& signals, double acceleration) noexcept {
  torso_ = (1.0 - leak_) * (torso_ + acceleration * time_step_);
  for (std::size_t side = 0; side < 2; ++side) {
    const LegSignals& leg = signals.leg[side];
    is_measured_[side] = std::isfinite(leg.hip.position) && std::isfinite(leg.knee.position) &&
                         is_velocity(leg.hip.velocity) && is_velocity(leg.knee.velocity);
    if (is_measured_[side]) velocity_[side] = torso_ + axle_velocity(geometry_, leg);
  }
}

WheelObservations::WheelObservations(const ForceKinematicsConfig& config)
    : loads_(loads_of(config)), motion_(config) {}

void WheelObservations::reset() noexcept {
  loads_.reset();
  motion_.reset();
}

WheelLoads::Step WheelObservations::update(const Signals& signals) noexcept {
  WheelLoads::Step step = loads_.update(signals);
  if (step.restart) motion_.reset();
  motion_.update(signals, step.acceleration_good ? signals.vertical_acceleration : 0.0);
  for (std::size_t side = 0; side < 2; ++side) {
    step.is_measured[side] = step.is_measured[side] && motion_.is_measured(side);
  }
  return step;
}

double log_likelihood_ratio(const ForceKinematicsModel& model,
                            const WheelObservation& observation) noexcept {
  return log_deviation_ratio(model) + exponent_ratio(model, observation);
}

ForceKinematics::ForceKinematics(const ForceKinematicsModel& model,
                                 const ForceKinematicsConfig& config)
    : model_(model), observations_(config), threshold_(config.threshold) {
  if (!(is_sensible(model.air) && is_sensible(model.contact))) {
    throw InputError(
        "force kinematics: means must be finite, deviations and rates positive and finite");
  }
  if (!(touchdown::is_sensible(loads_of(config)) && config.leak > 0.0 && config.threshold > 0.0 &&
        config.threshold < 1.0)) {
    throw InputError(
        "force kinematics: lengths (m), largest_force (N) and leak (s) must be positive, low_pass "
        "not negative (s), threshold between 0 and 1");
  }
  log_deviation_ratio_ = log_deviation_ratio(model);
  const double step = 1.0 / config.sample_rate;
  takeoff_ = -std::expm1(-step * model.contact.leaving_rate);
  landing_ = -std::expm1(-step * model.air.leaving_rate);
}

void ForceKinematics::reset() noexcept {
  observations_.reset();
  p_air_ = {0.5, 0.5};
  belief_ = Belief{};
}

const Belief& ForceKinematics::estimate(const Signals& signals) noexcept {
  const WheelLoads::Step step = observations_.update(signals);
  belief_.status = step.status;
  for (std::size_t side = 0; side < 2; ++side) {
    WheelBelief& wheel = belief_.wheel[side];
    wheel.load = step.load[side];
    double& p_air = p_air_[side];
    if (!step.is_measured[side] || step.status == SignalStatus::gap) {
      wheel.p_contact = observations_.relaxed(wheel.p_contact, step.elapsed);
      p_air = observations_.relaxed(p_air, step.elapsed);
    }
    if (!step.is_measured[side]) continue;  // the last decision stands
    const double contact = (1.0 - takeoff_) * wheel.p_contact + landing_ * p_air;
    const double air = takeoff_ * wheel.p_contact + (1.0 - landing_) * p_air;
    const double logit = std::log(contact / air) + log_deviation_ratio_ +
                         exponent_ratio(model_, observations_.of(side));
    wheel.p_contact = 1.0 / (1.0 + std::exp(-logit));
    p_air = 1.0 / (1.0 + std::exp(logit));
    wheel.contact = wheel.p_contact >= threshold_;
  }
  multiply_wheels(belief_);
  return belief_;
}

}  // namespace touchdown
