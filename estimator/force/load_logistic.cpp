#include "estimator/force/load_logistic.hpp"

#include <cmath>

#include "core/error.hpp"

namespace touchdown {

WheelLoadsConfig loads_of(const LoadLogisticConfig& config) noexcept {
  return {.sample_rate = config.sample_rate,
          .geometry = config.geometry,
          .low_pass = config.low_pass,
          .largest = config.largest_force,
          .guard = config.guard};
}

LoadLogistic::LoadLogistic(const LogisticCurve& curve, const LoadLogisticConfig& config)
    : curve_(curve), threshold_(config.threshold), loads_(loads_of(config)) {
  if (!(std::isfinite(curve.slope) && std::isfinite(curve.intercept))) {
    throw InputError("load logistic: slope (1/N) and intercept must be finite");
  }
  if (!(is_sensible(loads_of(config)) && config.threshold > 0.0 && config.threshold < 1.0)) {
    throw InputError(
        "load logistic: lengths (m) and largest_force (N) must be positive, low_pass not negative "
        "(s), threshold between 0 and 1");
  }
}

void LoadLogistic::reset() noexcept {
  loads_.reset();
  belief_ = Belief{};
}

const Belief& LoadLogistic::estimate(const Signals& signals) noexcept {
  loads_.update(signals, belief_, [this](WheelBelief& wheel, double force) {
    wheel.p_contact = curve_(force);
    wheel.contact = wheel.p_contact >= threshold_;
  });
  return belief_;
}

}  // namespace touchdown
