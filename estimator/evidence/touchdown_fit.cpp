#include "estimator/evidence/touchdown_fit.hpp"

#include "estimator/decision/fit.hpp"
#include "estimator/decision/training.hpp"

namespace touchdown {

TouchdownModel fit_touchdown_model(std::span<const LabelledRun> runs, const DecisionConfig& config,
                                   const DecisionFitConfig& network,
                                   const EvidenceFitConfig& evidence,
                                   const std::function<void()>& before_step) {
  check_decision_config(config);
  check_decision_fit_config(network);
  check_evidence_fit_config(evidence);
  const DecisionRows rows = decision_rows(runs, config, network, before_step);
  TouchdownModel model = {train_evidence_model(rows, evidence, before_step),
                          train_decision_model(rows, network, before_step)};
  const float offset = weights_offset(rows);
  model.evidence.bias += offset;
  model.network.last_bias += offset;
  return model;
}

}  // namespace touchdown
