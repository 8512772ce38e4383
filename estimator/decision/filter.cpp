#include "estimator/decision/filter.hpp"

namespace touchdown {

DecisionNetwork::DecisionNetwork(const DecisionModel& model, const DecisionConfig& config)
    : network_(model), decision_(config, !model.servo_weight.empty()) {
  check_decision_model(model);
}

const Belief& DecisionNetwork::estimate(const Signals& signals) noexcept {
  const std::array<bool, 2>& is_valid = decision_.update(signals);
  std::array<float, 2> logits{};
  if (is_valid[0] || is_valid[1]) {
    decision_.features().compute_pair_inputs();
    logits = network_.logits(decision_.features().pair_inputs());
  }
  return decision_.decide({logits[0], logits[1]});
}

}  // namespace touchdown
