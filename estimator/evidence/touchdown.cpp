#include "estimator/evidence/touchdown.hpp"

#include "core/error.hpp"

namespace touchdown {

namespace {

const TouchdownModel& checked(const TouchdownModel& model) {
  check_evidence_model(model.evidence);
  check_decision_model(model.network);
  if (model.evidence.servo_curve.empty() != model.network.servo_weight.empty()) {
    throw InputError("touchdown: expected the load by the servo law in curves and network");
  }
  return model;
}

}  // namespace

TouchdownEstimator::TouchdownEstimator(const TouchdownModel& model, const DecisionConfig& config)
    : evidence_(checked(model).evidence),
      network_(model.network),
      decision_(config, !model.network.servo_weight.empty()) {}

const Belief& TouchdownEstimator::estimate(const Signals& signals) noexcept {
  const std::array<bool, 2>& is_valid = decision_.update(signals);
  std::array<double, 2> logit{};
  if (is_valid[0] || is_valid[1]) {
    const std::array<float, 2> of_curves =
        evidence_.logits(decision_.left_inputs(), decision_.left_servo_load());
    const std::array<float, 2> of_network = network_.logits(decision_.pair_inputs());
    for (std::size_t side = 0; side < 2; ++side) {
      logit[side] = 0.5 * static_cast<double>(of_curves[side] + of_network[side]);
    }
  }
  return decision_.decide(logit);
}

}  // namespace touchdown
