#pragma once

#include <memory>

#include "estimator/contact_estimator.hpp"
#include "estimator/phase/config.hpp"
#include "estimator/phase/model.hpp"
#include "estimator/phase/prepared_model.hpp"
#include "estimator/signal_guard.hpp"

namespace touchdown {

/// A hidden Markov model over the contact phases of both legs, run forward
/// (docs/explanation/phase_filter.md). The paper's filter estimates whether a wheel is in contact
/// now. This one estimates in which phase between rolling and falling the robot is, from the signed
/// knee and wheel torques of both legs and the vertical acceleration. P(left wheel in contact) is
/// the sum over all phases in which it is.
///
/// `update` never throws, allocates or locks, and never returns NaN. A leg with torques that are
/// not finite gives no evidence at that step. Without a usable acceleration, or without torques of
/// either leg, the belief relaxes to the prior (`SignalGuard`), and the status gives the reason.
class PhaseFilter : public ContactEstimator {
 public:
  /// Throws InputError for an invalid model or configuration, and for a sample rate that is not the
  /// model's divided by a whole number.
  explicit PhaseFilter(PhaseModel model, const PhaseFilterConfig& config = {});
  /// The same with a model that `check_phase_model` accepts; many filters can share it.
  explicit PhaseFilter(std::shared_ptr<const PhaseModel> model,
                       const PhaseFilterConfig& config = {});

  void reset() noexcept override;

  [[nodiscard]] const Belief& belief() const noexcept { return belief_; }
  [[nodiscard]] const PhaseFilterConfig& config() const noexcept { return config_; }
  /// P(phase | all signals so far), which sums to one.
  [[nodiscard]] PhaseProbabilities phases() const noexcept;
  /// The sensor noise that the last step used.
  [[nodiscard]] PhaseNoise noise() const noexcept;

 private:
  const Belief& estimate(const Signals& signals) noexcept override;

  void reset_memory(double elapsed) noexcept;
  void estimate_noise(const Signals& signals, bool acceleration_good) noexcept;
  void apply_threshold() noexcept;

  PhaseFilterConfig config_;
  PreparedPhaseModel prepared_;
  SignalGuard guard_;
  alignas(64) PhaseValues<1> alpha_{};
  Belief belief_;
};

}  // namespace touchdown
