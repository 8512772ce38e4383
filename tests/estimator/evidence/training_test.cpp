#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "estimator/evidence/fit.hpp"
#include "tests/estimator/evidence/random_curves.hpp"
#include "tests/estimator/random.hpp"

namespace touchdown {
namespace {

DecisionRows empty_rows(int count) {
  DecisionRows rows;
  rows.inputs.setZero(static_cast<int>(decision_inputs), count);
  rows.is_contact.setZero(count);
  rows.weight = Eigen::RowVectorXf::Ones(count);
  return rows;
}

/// One input, drawn from N(1, 1) in contact and as often from N(−1, 1) without. All others are
/// zero. By Bayes' rule the logit is twice the input.
DecisionRows two_gaussians(int count, std::size_t input, std::uint32_t seed) {
  test::Normal normal(seed);
  DecisionRows rows = empty_rows(count);
  for (int row = 0; row < count; ++row) {
    rows.is_contact[row] = row % 2 == 0 ? 1.0F : 0.0F;
    rows.inputs(static_cast<int>(input), row) =
        static_cast<float>((row % 2 == 0 ? 1.0 : -1.0) + normal());
  }
  return rows;
}

constexpr EvidenceFitConfig brisk = {
    .descent = {.batch = 256, .epochs = 20, .learning_rate = 0.02, .decay = 0.0}};

float curve_at(const EvidenceModel& model, std::size_t input, float x) {
  EvidenceModel alone;
  alone.curve[input] = model.curve[input];
  DecisionInputs inputs{};
  inputs[input] = x;
  return evidence_logit(alone, inputs);
}

TEST(EvidenceTraining, FindsTheLinearLogitOfTwoGaussians) {
  constexpr std::size_t input = 3;
  const EvidenceModel model = train_evidence_model(two_gaussians(40'000, input, 1), brisk);
  for (float x = -2.0F; x <= 2.0F; x += 0.25F) {
    EXPECT_NEAR(model.bias + curve_at(model, input, x), 2.0F * x, 0.35F) << x;
  }
  EXPECT_NEAR(model.bias, 0.0F, 0.15F);
}

TEST(EvidenceTraining, LeavesACurveFlatWhereNoRowsLie) {
  const EvidenceModel model = train_evidence_model(two_gaussians(4000, 3, 2), brisk);
  for (std::size_t i = 0; i < decision_inputs; ++i) {
    if (i == 3) continue;
    // All rows have the same value of this input, so it gives no evidence.
    for (const float value : model.curve[i]) ASSERT_NEAR(value, 0.0F, 0.1F) << i;
  }
  // Beyond the outer knots the curve is constant.
  const auto& [low, high] = model.seen[3];
  EXPECT_LT(low, -3.0F);
  EXPECT_GT(high, 3.0F);
  EXPECT_LT(high, 4.5F);
  EXPECT_EQ(curve_at(model, 3, 4.0F), curve_at(model, 3, 60.0F));
}

TEST(EvidenceTraining, CentresEveryCurveOverItsRows) {
  test::Normal normal(4);
  DecisionRows rows = two_gaussians(5000, 7, 3);
  for (Eigen::Index row = 0; row < rows.weight.size(); ++row) {
    rows.weight[row] = 1.0F + static_cast<float>(row % 3);
    for (int i = 0; i < rows.inputs.rows(); ++i) {
      rows.inputs(i, row) += static_cast<float>(0.5 + normal());
    }
  }
  const EvidenceModel model = train_evidence_model(rows, brisk);
  const auto mean_of = [&](const EvidenceModel& alone) {
    double sum = 0.0;
    for (Eigen::Index row = 0; row < rows.inputs.cols(); ++row) {
      DecisionInputs inputs;
      std::copy_n(rows.inputs.col(row).data(), decision_inputs, inputs.begin());
      sum += static_cast<double>(rows.weight[row] * evidence_logit(alone, inputs));
    }
    return sum / static_cast<double>(rows.weight.sum());
  };
  for (std::size_t i = 0; i < decision_inputs; ++i) {
    EvidenceModel alone;
    alone.curve[i] = model.curve[i];
    ASSERT_NEAR(mean_of(alone), 0.0, 1e-4) << i;
  }
}

TEST(EvidenceTraining, IsSmootherTheLargerTheSmoothnessCost) {
  constexpr std::size_t input = 11;  // of the wheel's reaction: free to fall
  const DecisionRows rows = two_gaussians(4000, input, 7);
  const auto roughness = [&](double smoothness) {
    EvidenceFitConfig config = brisk;
    config.smoothness = smoothness;
    const EvidenceCurve curve = train_evidence_model(rows, config).curve[input];
    double sum = 0.0;
    for (std::size_t k = 1; k < curve.size(); ++k) {
      sum += std::pow(static_cast<double>(curve[k] - curve[k - 1]), 2);
    }
    return sum;
  };
  const double free = roughness(0.0);
  const double smooth = roughness(0.01);
  EXPECT_LT(smooth, 0.7 * free);
  EXPECT_LT(roughness(1.0), 0.1 * smooth);
}

TEST(EvidenceLoss, HasTheGradientOfItsFiniteDifferences) {
  const EvidenceModel model = test::random_curves(8);
  DecisionRows rows = empty_rows(30);
  test::Normal normal(9);
  for (Eigen::Index row = 0; row < rows.inputs.cols(); ++row) {
    for (int i = 0; i < rows.inputs.rows(); ++i) {
      rows.inputs(i, row) = static_cast<float>(2.0 * normal());
    }
    rows.is_contact[row] = static_cast<float>(row % 2);
    rows.weight[row] = 1.0F + static_cast<float>(row % 3);
  }
  EvidenceModel gradient;
  static_cast<void>(evidence_loss(model, rows, &gradient));
  double largest = 0.0;
  const auto check = [&](float& number, EvidenceModel& moved, float found) {
    constexpr float step = 0.05F;
    const float value = number;
    number = value + step;
    const double up = evidence_loss(moved, rows);
    number = value - step;
    const double expected = (up - evidence_loss(moved, rows)) / (2.0 * step);
    number = value;
    ASSERT_NEAR(found, expected, 2e-5);
    largest = std::max(largest, std::abs(expected));
  };
  EvidenceModel moved = model;
  for (const std::size_t i : {std::size_t{0}, std::size_t{40}, std::size_t{81}}) {
    for (std::size_t k = 0; k < evidence_knots; ++k) {
      check(moved.curve[i][k], moved, gradient.curve[i][k]);
    }
  }
  check(moved.bias, moved, gradient.bias);
  EXPECT_GT(largest, 0.01);
}

TEST(EvidenceTraining, RepeatsItselfToTheBit) {
  const DecisionRows rows = two_gaussians(2000, 5, 10);
  EvidenceFitConfig config = brisk;
  config.descent.epochs = 2;
  const EvidenceModel once = train_evidence_model(rows, config);
  EXPECT_EQ(train_evidence_model(rows, config), once);
  config.descent.seed = 2;
  EXPECT_FALSE(train_evidence_model(rows, config) == once);
}

TEST(MakeMonotone, GivesTheNearestCurveThatNeverFalls) {
  // The reference: each value is max over a ≤ k of min over b ≥ k of the mean from a to b.
  test::Normal normal(20);
  for (int round = 0; round < 50; ++round) {
    EvidenceCurve curve;
    const double slope = 0.1 * (round % 5 - 2);
    for (std::size_t k = 0; k < curve.size(); ++k) {
      curve[k] = static_cast<float>(slope * static_cast<double>(k) + normal());
    }
    EvidenceCurve monotone = curve;
    make_monotone(monotone);
    for (std::size_t k = 0; k < curve.size(); ++k) {
      double largest = -HUGE_VAL;
      for (std::size_t a = 0; a <= k; ++a) {
        double smallest = HUGE_VAL;
        for (std::size_t b = k; b < curve.size(); ++b) {
          double sum = 0.0;
          for (std::size_t i = a; i <= b; ++i) sum += static_cast<double>(curve[i]);
          smallest = std::min(smallest, sum / static_cast<double>(b - a + 1));
        }
        largest = std::max(largest, smallest);
      }
      ASSERT_NEAR(monotone[k], largest, 1e-5) << round << " " << k;
    }
    EvidenceCurve again = monotone;
    make_monotone(again);
    for (std::size_t k = 0; k < curve.size(); ++k) ASSERT_NEAR(again[k], monotone[k], 1e-6);
  }
}

/// Contact is likely at medium values of an input only.
DecisionRows peak(int count, bool of_servo_load, std::size_t input) {
  test::Normal normal(21);
  DecisionRows rows = empty_rows(count);
  if (of_servo_load) rows.servo.setZero(static_cast<int>(2 * decision_scales), count);
  for (int row = 0; row < count; ++row) {
    const double x = 1.5 * normal();
    rows.is_contact[row] = std::abs(x) < 1.0 ? 1.0F : 0.0F;
    (of_servo_load ? rows.servo(static_cast<int>(input), row)
                   : rows.inputs(static_cast<int>(input), row)) = static_cast<float>(x);
  }
  return rows;
}

TEST(EvidenceTraining, KeepsCurvesOfTheOwnLoadAndOfMotionsFromFalling) {
  const auto largest_fall = [](const EvidenceCurve& curve) {
    float fall = 0.0F;
    for (std::size_t k = 1; k < curve.size(); ++k) fall = std::max(fall, curve[k - 1] - curve[k]);
    return fall;
  };
  // Of each channel the first and the last scale: own load, reaction, axle velocity and
  // acceleration, the same of the other leg, vertical acceleration, roll rate.
  const std::vector<bool> of_torques = {true,  false, true,  true, false,
                                        false, false, false, true, false};
  for (const bool of_servo_load : {false, true}) {
    const std::vector<bool> rises = of_servo_load ? std::vector<bool>{true, false} : of_torques;
    for (std::size_t end = 0; end < 2 * rises.size(); ++end) {
      const std::size_t channel = end / 2;
      const std::size_t input =
          channel * decision_scales + (end % 2 == 0 ? 0 : decision_scales - 1);
      const DecisionRows rows = peak(8000, of_servo_load, input);
      const auto curve_of = [&](const EvidenceFitConfig& config) {
        const EvidenceModel model = train_evidence_model(rows, config);
        return of_servo_load ? model.servo_curve[input] : model.curve[input];
      };
      const float fall = largest_fall(curve_of(brisk));
      if (rises[channel]) {
        EXPECT_LT(fall, 1e-5F) << input;
      } else {
        EXPECT_GT(fall, 0.5F) << input;
      }
      EvidenceFitConfig free = brisk;
      free.monotone = false;
      EXPECT_GT(largest_fall(curve_of(free)), 0.5F) << input;
    }
  }
}

TEST(EvidenceTraining, RefusesInvalidValues) {
  EXPECT_THROW(check_evidence_fit_config({.smoothness = -1.0}), InputError);
  EXPECT_THROW(check_evidence_fit_config({.smoothness = std::nan("")}), InputError);
  EXPECT_THROW(check_evidence_fit_config({.descent = {.batch = 0}}), InputError);
}

TEST(EvidenceTraining, FindsTheLogitOfTheServoLoad) {
  // As `two_gaussians`, of one of the optional inputs.
  test::Normal normal(12);
  DecisionRows rows = empty_rows(40'000);
  rows.servo.setZero(static_cast<int>(2 * decision_scales), rows.inputs.cols());
  constexpr std::size_t input = 11;
  for (Eigen::Index row = 0; row < rows.servo.cols(); ++row) {
    rows.is_contact[row] = row % 2 == 0 ? 1.0F : 0.0F;
    rows.servo(static_cast<int>(input), row) =
        static_cast<float>((row % 2 == 0 ? 1.0 : -1.0) + normal());
  }
  const EvidenceModel model = train_evidence_model(rows, brisk);
  ASSERT_EQ(model.servo_curve.size(), 2 * decision_scales);
  ASSERT_EQ(model.servo_seen.size(), 2 * decision_scales);
  EXPECT_LT(model.servo_seen[input][0], -3.0F);
  EXPECT_GT(model.servo_seen[input][1], 3.0F);
  for (float x = -2.0F; x <= 2.0F; x += 0.25F) {
    EXPECT_NEAR(model.bias + evidence_at(model.servo_curve[input], x), 2.0F * x, 0.35F) << x;
    // Both wheels from one evaluation: of the left wheel it is the other leg's input.
    ServoLoadInputs servo{};
    servo[input] = x;
    const std::array<float, 2> logits = PairedEvidence(model).logits({}, servo);
    EXPECT_NEAR(logits[0], evidence_logit(model, {}, servo), 1e-4F);
    EXPECT_NEAR(logits[1], evidence_logit(model, {}, of_other_wheel(servo)), 1e-4F);
  }
}

}  // namespace
}  // namespace touchdown
