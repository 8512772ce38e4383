#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "estimator/decision/feature_extractor.hpp"
#include "estimator/decision/network.hpp"

namespace touchdown {

/// Every curve is linear between this many evenly spaced knots, which span the range of a
/// compressed input. It is constant beyond them, which only the logarithms of noise levels reach.
inline constexpr std::size_t evidence_knots = 33;
inline constexpr float evidence_reach = saturation;

using EvidenceCurve = std::array<float, evidence_knots>;

/// An additive model (GAM) of contact: ln P(contact) / P(no contact) is the sum of a bias and a
/// curve of each input. The same for both wheels.
struct EvidenceModel {
  std::array<EvidenceCurve, decision_inputs> curve{};  ///< nats at the knots
  float bias = 0.0F;
  /// Curves of `ServoLoadInputs` and their ranges as below; empty without this channel.
  std::vector<EvidenceCurve> servo_curve = {};
  std::vector<std::array<float, 2>> servo_seen = {};
  /// The range of each input that holds all but two in a thousand of the fitted rows. Only figures
  /// and tables use it: beyond this range a curve is hardly supported by data.
  std::array<std::array<float, 2>, decision_inputs> seen{};

  bool operator==(const EvidenceModel&) const = default;
};

/// The curves of a fit. With the load by the servo law they are two models of the same runs: an
/// additive model cannot give the other inputs more weight at steps where this load is muted.
struct EvidenceCurveSets {
  EvidenceCurveSets() = default;
  /// One model for all steps.
  EvidenceCurveSets(EvidenceModel all_steps) : usual(std::move(all_steps)) {}
  EvidenceCurveSets(EvidenceModel with_targets, EvidenceModel muted)
      : usual(std::move(with_targets)), without_targets(std::move(muted)) {}

  EvidenceModel usual;
  /// For steps at which the load by the servo law is muted: targets or gains are missing. `usual`
  /// serves them, too, if this is empty.
  std::optional<EvidenceModel> without_targets;

  bool operator==(const EvidenceCurveSets&) const = default;
};

/// Whether a model uses the targets of the joints, as a word for tables: "with" or "without".
[[nodiscard]] inline const char* targets_of(const EvidenceModel& model) noexcept {
  return model.servo_curve.empty() ? "without" : "with";
}

/// All curves of a model in one order: those of `DecisionInputs`, then those of `ServoLoadInputs`.
[[nodiscard]] inline std::size_t curve_count(const EvidenceModel& model) noexcept {
  return decision_inputs + model.servo_curve.size();
}
[[nodiscard]] inline auto& curve_of(auto& model, std::size_t i) noexcept {
  return i < decision_inputs ? model.curve[i] : model.servo_curve[i - decision_inputs];
}
[[nodiscard]] inline auto& seen_by(auto& model, std::size_t i) noexcept {
  return i < decision_inputs ? model.seen[i] : model.servo_seen[i - decision_inputs];
}

/// The position of an input: between this knot, counted from 0, and the next, by this share.
struct EvidencePosition {
  int knot = 0;
  float share = 0.0F;
};

/// The position of an input, limited to the outer knots.
[[nodiscard]] inline EvidencePosition evidence_position(float input) noexcept {
  constexpr auto last = static_cast<float>(evidence_knots - 1);
  const float x = (input + evidence_reach) * (last / (2.0F * evidence_reach));
  const float inside = x > 0.0F ? (x < last ? x : last) : 0.0F;
  const auto whole = static_cast<int>(inside);
  constexpr int last_knot = static_cast<int>(evidence_knots) - 2;
  const int knot = whole < last_knot ? whole : last_knot;
  return {knot, inside - static_cast<float>(knot)};
}

/// The curve's log-odds contribution at this input (nats).
[[nodiscard]] inline float evidence_at(const EvidenceCurve& curve, float input) noexcept {
  const EvidencePosition at = evidence_position(input);
  const float* const knot = curve.data() + at.knot;
  return knot[0] + at.share * (knot[1] - knot[0]);
}

/// ln P(contact) / P(no contact) of one wheel.
[[nodiscard]] float evidence_logit(const EvidenceModel& model, const DecisionInputs& inputs,
                                   const ServoLoadInputs& servo = {}) noexcept;

/// Evaluates the model for both wheels at once. Their inputs are the same numbers in another order,
/// so each is looked up once, for its contribution to both wheels.
class PairedEvidence {
 public:
  explicit PairedEvidence(const EvidenceModel& model);

  /// `evidence_logit` of the left and of the right wheel, from the inputs of the left one, up to
  /// rounding.
  [[nodiscard]] std::array<float, 2> logits(const DecisionInputs& left,
                                            const ServoLoadInputs& left_servo = {}) const noexcept;

 private:
  /// For each knot, the contribution to the wheel of the input (of a common input: to the left
  /// wheel), and to the other wheel.
  using Curves = std::array<std::array<float, 2>, evidence_knots>;

  /// The curves of a leg's inputs, the vertical acceleration, the roll rate and the noise levels.
  std::array<Curves, decision_inputs - DecisionPairInputs::of_legs> curve_{};
  std::vector<Curves> servo_curve_;  ///< of one leg's `ServoLoadInputs`
  float bias_;
};

/// The mean of two models, curve by curve: its logit is the mean of theirs. The first one has this
/// weight, the second one the rest. If only the second has servo curves, its model for steps
/// without targets counts. Throws InputError if it lacks a channel of the first.
[[nodiscard]] EvidenceCurveSets mean_of(const EvidenceCurveSets& one,
                                        const EvidenceCurveSets& other, double weight);

/// Throw InputError for numbers that are not finite, for a wrong number of curves, …
void check_evidence_model(const EvidenceModel& model);
/// … and for servo curves in the model of steps without targets, or none beside it.
void check_evidence_curve_sets(const EvidenceCurveSets& sets);

}  // namespace touchdown
