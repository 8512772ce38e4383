#include "estimator/evidence/curves.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include <Eigen/Core>

#include "core/error.hpp"

namespace touchdown {

namespace {

/// `evidence_position` of all inputs.
template <std::size_t count>
struct Positions {
  alignas(32) std::array<int, count> knot;
  alignas(32) std::array<float, count> share;
};

/// In separate loops: in a single loop, compilers make branches or nearly as many blends.
template <std::size_t count>
Positions<count> positions_of(const std::array<float, count>& inputs) noexcept {
  constexpr auto last = static_cast<float>(evidence_knots - 1);
  constexpr float knots_per_unit = last / (2.0F * evidence_reach);
  std::array<float, count> inside;
  for (std::size_t i = 0; i < count; ++i) {
    const float x = inputs[i] * knots_per_unit + evidence_reach * knots_per_unit;
    inside[i] = x > 0.0F ? x : 0.0F;
  }
  for (float& x : inside) x = x < last ? x : last;
  Positions<count> at;
  for (std::size_t i = 0; i < count; ++i) {
    at.knot[i] = std::min(static_cast<int>(inside[i]), static_cast<int>(evidence_knots) - 2);
    at.share[i] = inside[i] - static_cast<float>(at.knot[i]);
  }
  return at;
}

/// Both have the same channels. A range contains those of both.
EvidenceModel mean_of_models(EvidenceModel one, const EvidenceModel& other, float weight) {
  const auto mix = [weight](auto& curves, const auto& others) {
    for (std::size_t i = 0; i < curves.size(); ++i) {
      for (std::size_t k = 0; k < evidence_knots; ++k) {
        curves[i][k] = weight * curves[i][k] + (1.0F - weight) * others[i][k];
      }
    }
  };
  const auto unite = [](auto& ranges, const auto& others) {
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      ranges[i] = {std::min(ranges[i][0], others[i][0]), std::max(ranges[i][1], others[i][1])};
    }
  };
  mix(one.curve, other.curve);
  mix(one.servo_curve, other.servo_curve);
  unite(one.seen, other.seen);
  unite(one.servo_seen, other.servo_seen);
  one.bias = weight * one.bias + (1.0F - weight) * other.bias;
  return one;
}

bool all_finite(const auto& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](float x) { return std::isfinite(x); });
}

}  // namespace

float evidence_logit(const EvidenceModel& model, const DecisionInputs& inputs,
                     const ServoLoadInputs& servo) noexcept {
  float sum = model.bias;
  for (std::size_t i = 0; i < decision_inputs; ++i) sum += evidence_at(model.curve[i], inputs[i]);
  for (std::size_t i = 0; i < model.servo_curve.size(); ++i) {
    sum += evidence_at(model.servo_curve[i], servo[i]);
  }
  return sum;
}

PairedEvidence::PairedEvidence(const EvidenceModel& model) : bias_(model.bias) {
  constexpr std::size_t of_legs = DecisionPairInputs::of_legs;
  constexpr std::size_t roll = of_legs + decision_scales;
  for (std::size_t i = 0; i < curve_.size(); ++i) {
    for (std::size_t k = 0; k < evidence_knots; ++k) {
      const std::size_t own = i < of_legs ? i : of_legs + i;
      const std::size_t other = of_legs + i;
      // The roll rate has the opposite sign for the other wheel.
      const bool is_roll = i >= roll && i < roll + decision_scales;
      curve_[i][k] = {model.curve[own][k],
                      model.curve[other][is_roll ? evidence_knots - 1 - k : k]};
    }
  }
  if (model.servo_curve.empty()) return;
  servo_curve_.resize(decision_scales);
  for (std::size_t i = 0; i < decision_scales; ++i) {
    for (std::size_t k = 0; k < evidence_knots; ++k) {
      servo_curve_[i][k] = {model.servo_curve[i][k], model.servo_curve[decision_scales + i][k]};
    }
  }
}

std::array<float, 2> PairedEvidence::logits(const DecisionInputs& left,
                                            const ServoLoadInputs& left_servo) const noexcept {
  constexpr std::size_t of_legs = DecisionPairInputs::of_legs;
  const Positions<decision_inputs> at = positions_of(left);
  // The contributions of a knot and the next one, each to one wheel and to the other.
  using Four = Eigen::Array4f;
  const Four here(1.0F, 1.0F, 0.0F, 0.0F);
  const Four onwards(-1.0F, -1.0F, 1.0F, 1.0F);
  const auto contribution = [&](const Curves& curve, const auto& positions,
                                std::size_t input) -> Four {
    const float* const from = curve[static_cast<std::size_t>(positions.knot[input])].data();
    return Eigen::Map<const Four>(from) * (here + onwards * positions.share[input]);
  };
  const auto of = [&](std::size_t curve, std::size_t input) -> Four {
    return contribution(curve_[curve], at, input);
  };
  // Four independent sums, so that no addition waits for the one before.
  static_assert(of_legs % 2 == 0 && std::tuple_size_v<decltype(curve_)> % 2 == 0);
  Four left_even = Four::Zero();
  Four left_odd = Four::Zero();
  Four right_even = Four::Zero();
  Four right_odd = Four::Zero();
  for (std::size_t i = 0; i < of_legs; i += 2) {
    left_even += of(i, i);
    left_odd += of(i + 1, i + 1);
    right_even += of(i, of_legs + i);
    right_odd += of(i + 1, of_legs + i + 1);
  }
  for (std::size_t i = of_legs; i < curve_.size(); i += 2) {
    left_even += of(i, of_legs + i);
    left_odd += of(i + 1, of_legs + i + 1);
  }
  if (!servo_curve_.empty()) {
    const Positions<std::tuple_size_v<ServoLoadInputs>> servo = positions_of(left_servo);
    for (std::size_t i = 0; i < decision_scales; i += 2) {
      left_even += contribution(servo_curve_[i], servo, i);
      left_odd += contribution(servo_curve_[i + 1], servo, i + 1);
      right_even += contribution(servo_curve_[i], servo, decision_scales + i);
      right_odd += contribution(servo_curve_[i + 1], servo, decision_scales + i + 1);
    }
  }
  const Four of_left = left_even + left_odd;
  const Four of_right = right_even + right_odd;
  return {
      bias_ + (of_left[0] + of_left[2]) + (of_right[1] + of_right[3]),
      bias_ + (of_left[1] + of_left[3]) + (of_right[0] + of_right[2]),
  };
}

EvidenceCurveSets mean_of(const EvidenceCurveSets& one, const EvidenceCurveSets& other,
                          double weight) {
  const auto share = static_cast<float>(weight);
  const auto* const without = other.without_targets ? &*other.without_targets : nullptr;
  const bool is_without = one.usual.servo_curve.empty() && !other.usual.servo_curve.empty();
  const EvidenceModel* const same = is_without ? without : &other.usual;
  if (same == nullptr || same->servo_curve.size() != one.usual.servo_curve.size() ||
      (one.without_targets && without == nullptr)) {
    throw InputError(std::string("evidence curves: expected curves ") + targets_of(one.usual) +
                     " targets of the joints, found only curves " + targets_of(other.usual));
  }
  EvidenceCurveSets mean = mean_of_models(one.usual, *same, share);
  if (one.without_targets) {
    mean.without_targets = mean_of_models(*one.without_targets, *without, share);
  }
  return mean;
}

void check_evidence_model(const EvidenceModel& model) {
  const std::size_t servo = model.servo_curve.size();
  if (!(servo == 0 || servo == std::tuple_size_v<ServoLoadInputs>)) {
    throw InputError("evidence curves: expected servo curves of every input, or none");
  }
  if (std::all_of(model.curve.begin(), model.curve.end(),
                  [](const auto& curve) { return all_finite(curve); }) &&
      std::all_of(model.servo_curve.begin(), model.servo_curve.end(),
                  [](const auto& curve) { return all_finite(curve); }) &&
      std::isfinite(model.bias)) {
    return;
  }
  throw InputError("evidence curves: their numbers must be finite");
}

void check_evidence_curve_sets(const EvidenceCurveSets& sets) {
  check_evidence_model(sets.usual);
  if (!sets.without_targets) return;
  check_evidence_model(*sets.without_targets);
  if (!sets.usual.servo_curve.empty() && sets.without_targets->servo_curve.empty()) return;
  throw InputError(
      "evidence curves: expected servo curves in the model for steps with targets, and none in "
      "that for steps without");
}

}  // namespace touchdown
