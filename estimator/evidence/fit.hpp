#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>

#include "estimator/decision/config.hpp"
#include "estimator/decision/descent.hpp"
#include "estimator/evidence/curves.hpp"
#include "estimator/labelled_run.hpp"

namespace touchdown {

/// Replaces a curve by the nearest one, in least squares over its knots, that never falls. Pools
/// adjacent violators: Ayer, Brunk, Ewing, Reid, Silverman (1955).
inline void make_monotone(EvidenceCurve& curve) noexcept {
  struct Pool {
    double mean;
    std::size_t knots;
  };
  std::array<Pool, evidence_knots> pools;
  std::size_t count = 0;
  for (const float value : curve) {
    pools[count++] = {static_cast<double>(value), 1};
    while (count > 1 && pools[count - 2].mean > pools[count - 1].mean) {
      Pool& before = pools[count - 2];
      const Pool& last = pools[count - 1];
      const std::size_t knots = before.knots + last.knots;
      before.mean = (before.mean * static_cast<double>(before.knots) +
                     last.mean * static_cast<double>(last.knots)) /
                    static_cast<double>(knots);
      before.knots = knots;
      --count;
    }
  }
  std::size_t knot = 0;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < pools[i].knots; ++k) {
      curve[knot++] = static_cast<float>(pools[i].mean);
    }
  }
}

/// How an `EvidenceModel` is fitted.
struct EvidenceFitConfig {
  /// The rows and the descent. Its decay pulls every number towards zero.
  DecisionFitConfig descent = {.learning_rate = 1e-2, .decay = 0.0, .class_exponent = -0.8};
  /// Half of this times the squared differences of neighbouring knots (nats²) is added to the loss.
  double smoothness = 1e-4;
  /// Whether more load on the wheel, by torques or by the servos' laws, an axle that moves or
  /// accelerates upwards, and a torso that accelerates upwards never count against contact: these
  /// curves do not fall, at any time scale. Free curves of both accelerations grow large and cancel
  /// in flights with passive legs, so that they fail where legs move in the air.
  bool monotone = true;

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

/// Fits evidence curves to the same rows as `fit_decision_model` fits the network. The logit means
/// the probability of contact in runs like these. The same runs and configuration give the same
/// numbers. Throws InputError as `fit_decision_model` does.
[[nodiscard]] EvidenceModel fit_evidence_model(std::span<const LabelledRun> runs,
                                               const DecisionConfig& config = {},
                                               const EvidenceFitConfig& fit = {},
                                               const std::function<void()>& before_step = {});

/// As above; with the load by the servo law, fits a second model without it to the same runs.
[[nodiscard]] EvidenceCurveSets fit_evidence_curve_sets(
    std::span<const LabelledRun> runs, const DecisionConfig& config = {},
    const EvidenceFitConfig& fit = {}, const std::function<void()>& before_step = {});

}  // namespace touchdown
