#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "estimator/decision/network.hpp"
#include "estimator/decision/feature_extractor.hpp"

namespace touchdown {

/// Every curve is linear between so many evenly spaced knots over all that a compressed input can
/// be, and constant beyond them, where only the logarithms of noise levels come.
inline constexpr std::size_t evidence_knots = 33;
inline constexpr float evidence_reach = saturation;
/// A pair's table is bilinear between every second knot of both.
inline constexpr std::size_t evidence_pair_knots = (evidence_knots + 1) / 2;

using EvidenceCurve = std::array<float, evidence_knots>;
/// By the first input, then by the second.
using EvidenceTable = std::array<float, evidence_pair_knots * evidence_pair_knots>;

/// Additive evidence for contact: ln P(contact) / P(no contact) is a bias, a curve of each input
/// and, if there are any, a table of each pair in `evidence_pairs`. The same for both wheels.
struct EvidenceModel {
  std::array<EvidenceCurve, decision_inputs> curve{};  ///< nats at its knots
  std::vector<EvidenceTable> table;                    ///< one per pair, or none
  float bias = 0.0F;
  /// Between these lie all but two in a thousand of the rows that were learned from. Only for
  /// people: what a curve says beyond is hearsay.
  std::array<std::array<float, 2>, decision_inputs> seen{};

  bool operator==(const EvidenceModel&) const = default;
};

/// Where an input lies: between this knot, counted from 0, and the next one, by this share.
struct EvidencePlace {
  int knot = 0;
  float share = 0.0F;
};

/// Between the outer knots, whatever the input.
[[nodiscard]] inline EvidencePlace evidence_place(float input, std::size_t knots) noexcept {
  const auto last = static_cast<float>(knots - 1);
  const float x = (input + evidence_reach) * (last / (2.0F * evidence_reach));
  const float inside = x > 0.0F ? (x < last ? x : last) : 0.0F;
  const auto whole = static_cast<int>(inside);
  const int knot = whole < static_cast<int>(knots) - 2 ? whole : static_cast<int>(knots) - 2;
  return {knot, inside - static_cast<float>(knot)};
}

/// What a curve says of its input (nats).
[[nodiscard]] inline float evidence_at(const EvidenceCurve& curve, float input) noexcept {
  const EvidencePlace at = evidence_place(input, evidence_knots);
  const float* const knot = curve.data() + at.knot;
  return knot[0] + at.share * (knot[1] - knot[0]);
}

/// ln P(contact) / P(no contact) of one wheel.
[[nodiscard]] float evidence_logit(const EvidenceModel& model,
                                   const DecisionInputs& inputs) noexcept;

/// The evidence of both wheels at once. What is heard of them are the same numbers in another
/// order, so each is looked up once, for what it says to one wheel and to the other.
class PairedEvidence {
 public:
  explicit PairedEvidence(const EvidenceModel& model);

  /// Of the left and of the right wheel, from what is heard of the left one: `evidence_logit` of
  /// each, up to rounding.
  [[nodiscard]] std::array<float, 2> logits(const DecisionInputs& left) const noexcept;

 private:
  /// By knot: what it says to the wheel that it is of, or to the left one; to the other one.
  using Curves = std::array<std::array<float, 2>, evidence_knots>;

  /// Of a leg's inputs, the vertical acceleration's, the roll rate's, the noise levels'.
  std::array<Curves, decision_inputs - DecisionPairInputs::of_legs> curve_{};
  std::vector<EvidenceTable> table_;
  float bias_;
};

/// Throws InputError for numbers that are not finite, and for tables of another number of pairs.
void check_evidence_model(const EvidenceModel& model);

}  // namespace touchdown
