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

const Belief& SupportForce::estimate(const Signals& signals) noexcept {
  loads_.update(signals, belief_, [this](WheelBelief& wheel, double force) {
    const double middle = 0.5 * (config_.contact + config_.release);
    wheel.p_contact = 1.0 / (1.0 + std::exp(-(force - middle) / config_.width));
    wheel.contact = force >= (wheel.contact ? config_.release : config_.contact);
  });
  return belief_;
}

}  // namespace touchdown
