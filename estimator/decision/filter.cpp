#include "estimator/decision/filter.hpp"

namespace touchdown {

DecisionNetwork::DecisionNetwork(const DecisionModel& model, const DecisionConfig& config)
    : model_(model), decision_(config) {
  check_decision_model(model);
}

const Belief& DecisionNetwork::update(const Signals& signals) noexcept {
  const std::array<bool, 2>& is_heard = decision_.hear(signals);
  std::array<double, 2> logit{};
  for (std::size_t side = 0; side < 2; ++side) {
    if (is_heard[side]) logit[side] = decision_logit(model_, decision_.inputs(side));
  }
  return decision_.decide(logit);
}

}  // namespace touchdown
