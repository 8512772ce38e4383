#pragma once

#include <functional>

#include "estimator/decision/config.hpp"
#include "estimator/decision/descent.hpp"
#include "estimator/evidence/curves.hpp"

namespace touchdown {

/// How an `EvidenceModel` is fitted.
struct EvidenceFitConfig {
  /// The rows and the descent. Its decay pulls every number towards zero.
  DecisionFitConfig descent = {.learning_rate = 1e-2, .decay = 0.0, .class_exponent = -0.8};
  /// Half of this times the squared differences of neighbouring knots (nats²) is added to the loss.
  double smoothness = 1e-4;
  /// Whether more load on the wheel, by torques or by the servos' laws, never counts against its
  /// contact: the curves of the own load do not fall, at any time scale.
  bool monotone_loads = true;

  bool operator==(const EvidenceFitConfig&) const = default;
};

/// Throws InputError for invalid values.
void check_evidence_fit_config(const EvidenceFitConfig& config);

/// The weighted mean of the cross-entropy of these rows, without the smoothness term. `gradient`,
/// unless null, gets its gradient; `seen` has none.
[[nodiscard]] double evidence_loss(const EvidenceModel& model, const DecisionRows& rows,
                                   EvidenceModel* gradient = nullptr);

/// Starts from flat curves and runs `descend`. The same rows and configuration give the same
/// numbers. Curves are centred: their weighted means over the rows are 0.
[[nodiscard]] EvidenceModel train_evidence_model(const DecisionRows& rows,
                                                 const EvidenceFitConfig& config,
                                                 const std::function<void()>& before_step = {});

}  // namespace touchdown
