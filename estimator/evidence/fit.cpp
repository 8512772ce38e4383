#include "estimator/evidence/fit.hpp"

#include "estimator/decision/fit.hpp"

namespace touchdown {

EvidenceModel fit_evidence_model(std::span<const LabelledRun> runs, const DecisionConfig& config,
                                 const EvidenceFitConfig& fit,
                                 const std::function<void()>& before_step) {
  check_decision_config(config);
  check_evidence_fit_config(fit);
  const DecisionRows rows = decision_rows(runs, config, fit.descent, before_step);
  EvidenceModel model = train_evidence_model(rows, fit, before_step);
  model.bias += weights_offset(rows);
  return model;
}

}  // namespace touchdown
