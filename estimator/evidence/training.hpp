#pragma once

#include <functional>

#include "estimator/decision/config.hpp"
#include "estimator/decision/descent.hpp"
#include "estimator/evidence/curves.hpp"

namespace touchdown {

/// How an `EvidenceModel` is fitted.
struct EvidenceFitConfig {
  /// What is learned from, and the descent. Its decay pulls every number towards no evidence.
  DecisionFitConfig descent = {.learning_rate = 1e-2, .decay = 0.0};
  /// Half of it times the squared differences of neighbouring knots (nats²) is added to the loss.
  double smoothness = 1e-4;
  bool with_pairs = false;  ///< whether the pairs get tables, too

  bool operator==(const EvidenceFitConfig&) const = default;
};

/// Throws InputError for values that make no sense.
void check_evidence_fit_config(const EvidenceFitConfig& config);

/// The weighted mean of the cross-entropy of these rows, and its gradient where one is asked for
/// (nothing of it is `seen`). Smoothness does not count.
[[nodiscard]] double evidence_loss(const EvidenceModel& model, const DecisionRows& rows,
                                   EvidenceModel* gradient = nullptr);

/// Curves that begin flat, then the descent of the network. The same rows and configuration give
/// the same numbers. Curves are centred: their weighted means over the rows are 0, those of tables
/// too.
[[nodiscard]] EvidenceModel train_evidence_model(const DecisionRows& rows,
                                                 const EvidenceFitConfig& config,
                                                 const std::function<void()>& before_step = {});

}  // namespace touchdown
