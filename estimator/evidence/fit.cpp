#include "estimator/evidence/fit.hpp"

#include <utility>

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

EvidenceCurveSets fit_evidence_curve_sets(std::span<const LabelledRun> runs,
                                          const DecisionConfig& config,
                                          const EvidenceFitConfig& fit,
                                          const std::function<void()>& before_step) {
  EvidenceModel usual = fit_evidence_model(runs, config, fit, before_step);
  if (!config.servo_load) return usual;
  DecisionConfig without_targets = config;
  without_targets.servo_load = false;
  return {std::move(usual), fit_evidence_model(runs, without_targets, fit, before_step)};
}

}  // namespace touchdown
