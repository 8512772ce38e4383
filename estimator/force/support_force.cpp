#include "estimator/force/support_force.hpp"

#include <cmath>

#include "core/error.hpp"

namespace touchdown {

namespace {

WheelLoadsConfig loads_of(const SupportForceConfig& config) {
  return {.sample_rate = config.sample_rate,
          .geometry = config.geometry,
          .low_pass = config.low_pass,
          .guard = config.guard};
}

}  // namespace

SupportForce::SupportForce(const SupportForceConfig& config)
    : config_(config), loads_(loads_of(config)) {
  if (!(is_sensible(loads_of(config)) && config.width > 0.0 && config.contact >= config.release)) {
    throw InputError(
        "support force: width (N) and lengths (m) must be positive, low_pass not negative (s), "
        "contact not below release (N)");
  }
  reset();
}

void SupportForce::reset() noexcept {
  loads_.reset();
  belief_ = Belief{};
}

const Belief& SupportForce::update(const Signals& signals) noexcept {
  const WheelLoads::Step step = loads_.update(signals);
  belief_.status = step.status;
  for (std::size_t side = 0; side < 2; ++side) {
    WheelBelief& wheel = belief_.wheel[side];
    if (step.is_measured[side]) {
      const double force = loads_.force(side);
      const double middle = 0.5 * (config_.contact + config_.release);
      wheel.p_contact = 1.0 / (1.0 + std::exp(-(force - middle) / config_.width));
      wheel.contact = force >= (wheel.contact ? config_.release : config_.contact);
    } else {  // the last decision stands
      wheel.p_contact = loads_.relaxed(wheel.p_contact, step.elapsed);
    }
  }
  multiply_wheels(belief_);
  return belief_;
}

}  // namespace touchdown
