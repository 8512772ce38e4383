#include "estimator/support_force.hpp"

#include <cmath>

#include "core/error.hpp"
#include "estimator/low_pass.hpp"

namespace touchdown {

namespace {

bool is_usable(const LegSignals& leg, const SignalGuardConfig& guard) noexcept {
  return is_torque(leg.hip.torque, guard) && is_torque(leg.knee.torque, guard) &&
         std::isfinite(leg.hip.position) && std::isfinite(leg.knee.position);
}

}  // namespace

double vertical_force(const LegGeometry& geometry, const LegSignals& leg, bool mirrored,
                      double acceleration) noexcept {
  constexpr double gravity = 9.81;
  const double sign = mirrored ? -1.0 : 1.0;
  const double hip = sign * leg.hip.position;
  const double knee = hip + sign * leg.knee.position;
  // Where the foot goes with each joint: ∂x/∂q, ∂z/∂q.
  const double upper_x = geometry.upper_length * std::cos(hip);
  const double upper_z = geometry.upper_length * std::sin(hip);
  const double lower_x = geometry.lower_length * std::cos(knee);
  const double lower_z = geometry.lower_length * std::sin(knee);
  // What the links and the wheel weigh on each joint, by their arms.
  const double below_knee = geometry.lower_centre * geometry.lower_mass + geometry.wheel_mass;
  const double on_knee = below_knee * lower_z;
  const double on_hip =
      (geometry.upper_centre * geometry.upper_mass + geometry.lower_mass + geometry.wheel_mass) *
          upper_z +
      on_knee;
  const double hip_load = -sign * leg.hip.torque + on_hip * (gravity + acceleration);
  const double knee_load = -sign * leg.knee.torque + on_knee * (gravity + acceleration);
  const double determinant = upper_x * lower_z - lower_x * upper_z;
  return ((upper_x + lower_x) * knee_load - lower_x * hip_load) / determinant;
}

SupportForce::SupportForce(const SupportForceConfig& config)
    : config_(config), guard_(config.guard, config.sample_rate) {
  const LegGeometry& geometry = config.geometry;
  if (!(config.low_pass >= 0.0 && config.width > 0.0 && geometry.upper_length > 0.0 &&
        geometry.lower_length > 0.0 && config.contact >= config.release)) {
    throw InputError(
        "support force: width (N) and lengths (m) must be positive, low_pass not negative (s), "
        "contact not below release (N)");
  }
  gain_ = exact_low_pass_gain(config.low_pass, config.sample_rate);
  reset();
}

void SupportForce::reset() noexcept {
  guard_.reset();
  force_ = {};
  is_started_ = {};
  belief_ = Belief{};
}

const Belief& SupportForce::update(const Signals& signals) noexcept {
  const SignalGuard::Verdict verdict = guard_.check(signals.time, signals.vertical_acceleration);
  belief_.status = verdict.status;
  if (verdict.restart) is_started_ = {};
  for (std::size_t side = 0; side < 2; ++side) {
    WheelBelief& wheel = belief_.wheel[side];
    const LegSignals& leg = signals.leg[side];
    const bool usable = is_usable(leg, config_.guard);
    const double force =
        usable && verdict.acceleration_good
            ? vertical_force(config_.geometry, leg, side == 1, signals.vertical_acceleration)
            : std::nan("");
    if (std::isfinite(force)) {
      force_[side] = is_started_[side] ? force_[side] + gain_ * (force - force_[side]) : force;
      is_started_[side] = true;
      const double middle = 0.5 * (config_.contact + config_.release);
      wheel.p_contact = 1.0 / (1.0 + std::exp(-(force_[side] - middle) / config_.width));
      wheel.contact = force_[side] >= (wheel.contact ? config_.release : config_.contact);
    } else {  // the last decision stands
      wheel.p_contact = guard_.relaxed(wheel.p_contact, verdict.elapsed);
      if (!usable && verdict.status == SignalStatus::good) belief_.status = SignalStatus::invalid;
    }
  }
  const double left = belief_.wheel[0].p_contact;
  const double right = belief_.wheel[1].p_contact;
  belief_.p_both_wheels = left * right;
  belief_.p_any_wheel = left + (1.0 - left) * right;
  return belief_;
}

}  // namespace touchdown
