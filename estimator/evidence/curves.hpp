#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "estimator/decision/network.hpp"

namespace touchdown {

/// Every curve is linear between so many evenly spaced knots from −6 to 6 of its compressed input,
/// and constant beyond them.
inline constexpr std::size_t evidence_knots = 33;
inline constexpr float evidence_reach = 6.0F;
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

/// Throws InputError for numbers that are not finite, and for tables of another number of pairs.
void check_evidence_model(const EvidenceModel& model);

}  // namespace touchdown
