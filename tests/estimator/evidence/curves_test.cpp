#include "estimator/evidence/curves.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "tests/estimator/evidence/random_curves.hpp"

namespace touchdown {
namespace {

double position_of_knot(std::size_t knot, std::size_t knots) {
  return -4.0 + 8.0 * static_cast<double>(knot) / static_cast<double>(knots - 1);
}

/// Hat functions by their definition, in double precision.
double share_of_knot(double x, std::size_t knot, std::size_t knots) {
  const double inside = std::clamp(x, -4.0, 4.0);
  const double width = 8.0 / static_cast<double>(knots - 1);
  return std::max(0.0, 1.0 - std::abs(inside - position_of_knot(knot, knots)) / width);
}

double logit_of(const EvidenceModel& model, const DecisionInputs& inputs) {
  double sum = model.bias;
  for (std::size_t i = 0; i < decision_inputs; ++i) {
    for (std::size_t k = 0; k < evidence_knots; ++k) {
      sum += share_of_knot(inputs[i], k, evidence_knots) * model.curve[i][k];
    }
  }
  return sum;
}

TEST(EvidenceLogit, AddsTheContributionsOfAllCurves) {
  const EvidenceModel model = test::random_curves(1);
  test::Normal normal(2);
  for (int round = 0; round < 200; ++round) {
    DecisionInputs inputs{};
    for (float& x : inputs) x = static_cast<float>(3.0 * normal());
    ASSERT_NEAR(evidence_logit(model, inputs), logit_of(model, inputs), 1e-4) << round;
  }
}

/// The other wheel's inputs, by their definition.
DecisionInputs of_the_other(const DecisionInputs& inputs) {
  constexpr std::size_t of_leg = decision_leg_channels * decision_scales;
  DecisionInputs other = inputs;
  for (std::size_t i = 0; i < of_leg; ++i) std::swap(other[i], other[of_leg + i]);
  for (std::size_t i = 0; i < decision_scales; ++i) {
    other[2 * of_leg + decision_scales + i] *= -1.0F;
  }
  return other;
}

TEST(PairedEvidence, EqualsTheLogitOfEachWheelAlone) {
  const EvidenceModel model = test::random_curves(6);
  const PairedEvidence paired(model);
  test::Normal normal(7);
  for (int round = 0; round < 200; ++round) {
    DecisionInputs left{};
    for (float& x : left) x = static_cast<float>(2.0 * normal());
    const DecisionInputs right = of_the_other(left);
    const std::array<float, 2> logits = paired.logits(left);
    ASSERT_NEAR(logits[0], logit_of(model, left), 1e-4) << round;
    ASSERT_NEAR(logits[1], logit_of(model, right), 1e-4) << round;
    ASSERT_GT(std::abs(logits[0] - logits[1]), 1e-4) << round;
  }
}

TEST(EvidenceModel, IsRefusedWithNumbersThatAreNotFinite) {
  const EvidenceModel good = test::random_curves(5);
  check_evidence_model(good);
  const auto refused = [](const EvidenceModel& model) {
    EXPECT_THROW(check_evidence_model(model), InputError);
  };
  EvidenceModel broken = good;
  broken.curve[81][32] = std::nanf("");
  refused(broken);
  broken = good;
  broken.servo_curve.resize(2 * decision_scales);
  broken.servo_curve[9][5] = HUGE_VALF;
  refused(broken);
  broken = good;
  broken.bias = -HUGE_VALF;
  refused(broken);
  broken = good;
  broken.servo_curve.emplace_back();
  refused(broken);
}

}  // namespace
}  // namespace touchdown
