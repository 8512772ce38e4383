#include "estimator/decision/config.hpp"

#include <cmath>

#include "core/error.hpp"

namespace touchdown {

namespace {

bool is_level(double x) { return std::isfinite(x) && x >= 0.0; }

}  // namespace

void check_decision_fit_config(const DecisionFitConfig& config) {
  if (config.passes == 0 || config.rows == 0 || config.batch == 0 || config.epochs == 0) {
    throw InputError("decision: passes, rows, batch and epochs must be positive");
  }
  if (!(config.steps_of_slow > 0 && config.share_slow >= 0.0 && config.share_slow <= 1.0)) {
    throw InputError(
        "decision network: steps_of_slow must be positive, share_slow between 0 and 1");
  }
  if (!(config.share_with_resets >= 0.0 && config.share_with_resets <= 1.0 &&
        std::isfinite(config.reset_after) && config.reset_after > 0.0 &&
        is_level(config.reset_after_noise))) {
    throw InputError(
        "decision: share_with_resets must be between 0 and 1, reset_after (s) positive, "
        "reset_after_noise (s per N·m) not negative");
  }
  if (!(std::isfinite(config.learning_rate) && config.learning_rate > 0.0 &&
        is_level(config.decay) && std::isfinite(config.class_exponent))) {
    throw InputError(
        "decision: learning_rate must be positive, decay not negative, class_exponent "
        "finite");
  }
  check_augmentation_config(config.augmentation);
}

void check_decision_config(const DecisionConfig& config) {
  const LegGeometry& leg = config.geometry;
  if (!(std::isfinite(config.sample_rate) && config.sample_rate > 0.0 && leg.upper_length > 0.0 &&
        leg.lower_length > 0.0 && std::isfinite(leg.robot_mass) && leg.robot_mass > 0.0)) {
    throw InputError(
        "decision: sample_rate (Hz), lengths (m) and robot_mass (kg) must be positive");
  }
  if (!(is_level(leg.hip_friction) && is_level(leg.knee_friction) &&
        is_level(leg.position_resolution))) {
    throw InputError(
        "decision: hip_friction, knee_friction (N·m) and position_resolution (rad) must not be "
        "negative");
  }
  if (!(is_level(leg.wheel_inertia) && is_level(config.difference) && is_level(config.smoothing))) {
    throw InputError(
        "decision: wheel_inertia (kg·m²), difference (s) and smoothing (s per N·m) must "
        "not be negative");
  }
  const OperatingPoint& point = config.point;
  if (!(point.leave_below > 0.0 && point.leave_below <= point.return_above &&
        point.return_above < 1.0)) {
    throw InputError("decision: leave_below and return_above must be probabilities in this order");
  }
  if (!(point.settle_at > 0.0 && point.settle_at < 1.0 && is_level(point.settle_after))) {
    throw InputError(
        "decision: settle_at must be a probability, and settle_after (s) must not be negative");
  }
}

}  // namespace touchdown
