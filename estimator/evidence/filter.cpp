#include "estimator/evidence/filter.hpp"

#include <utility>

namespace touchdown {

EvidenceCurves::EvidenceCurves(EvidenceModel model, const DecisionConfig& config)
    : model_(std::move(model)), decision_(config) {
  check_evidence_model(model_);
}

const Belief& EvidenceCurves::update(const Signals& signals) noexcept {
  const std::array<bool, 2>& is_heard = decision_.hear(signals);
  std::array<double, 2> logit{};
  for (std::size_t side = 0; side < 2; ++side) {
    if (is_heard[side]) logit[side] = evidence_logit(model_, decision_.inputs(side));
  }
  return decision_.decide(logit);
}

}  // namespace touchdown
