#include <array>
#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "estimator/evidence/channels.hpp"
#include "estimator/evidence/filter.hpp"
#include "tests/estimator/evidence/lifted_curves.hpp"
#include "tests/estimator/evidence/random_curves.hpp"

namespace touchdown {
namespace {

EvidenceModel with_servo_curves(EvidenceModel model) {
  test::Normal normal(11);
  model.servo_curve.resize(2 * decision_scales);
  model.servo_seen.resize(2 * decision_scales);
  for (EvidenceCurve& curve : model.servo_curve) {
    for (float& x : curve) x = static_cast<float>(0.3 * normal());
  }
  return model;
}

double sum_of(const Evidence::Contributions& c) {
  return c.load + c.ground_torque + c.axle_motion + c.torso + c.other_leg + c.offset;
}

/// The group of an input, from its channel's name.
double group_of(const Evidence::Contributions& c, const std::string& channel) {
  if (channel.starts_with("other_")) return c.other_leg;
  if (channel == "load" || channel == "servo_load") return c.load;
  if (channel == "reaction") return c.ground_torque;
  if (channel.starts_with("axle_")) return c.axle_motion;
  return c.torso;
}

TEST(Contributions, AddUpToTheLogOdds) {
  const EvidenceModel model = with_servo_curves(test::random_curves(3));
  test::Normal normal(4);
  for (int k = 0; k < 200; ++k) {
    DecisionInputs inputs{};
    ServoLoadInputs servo{};
    for (float& x : inputs) x = static_cast<float>(2.0 * normal());
    for (float& x : servo) x = static_cast<float>(2.0 * normal());
    EXPECT_NEAR(sum_of(evidence_contributions(model, inputs, servo)),
                static_cast<double>(evidence_logit(model, inputs, servo)), 1e-4);
  }
}

TEST(Contributions, PutEachCurveIntoTheGroupOfItsChannel) {
  const EvidenceModel empty = with_servo_curves(EvidenceModel());
  const auto flat = [](EvidenceCurve& curve) { curve.fill(2.5F); };
  const auto expect_only = [](const EvidenceModel& model, const std::string& channel) {
    const Evidence::Contributions c = evidence_contributions(model, {}, {});
    EXPECT_NEAR(group_of(c, channel), 2.5, 1e-6) << channel;
    EXPECT_NEAR(sum_of(c), 2.5, 1e-6) << channel;
  };
  EvidenceModel none = empty;
  for (EvidenceCurve& curve : none.servo_curve) curve.fill(0.0F);
  for (std::size_t i = 0; i < decision_channels * decision_scales; ++i) {
    EvidenceModel model = none;
    flat(model.curve[i]);
    expect_only(model, evidence_channels[i / decision_scales].name);
  }
  for (std::size_t i = 0; i < 2 * decision_scales; ++i) {
    EvidenceModel model = none;
    flat(model.servo_curve[i]);
    expect_only(model, servo_load_channels[i / decision_scales].name);
  }
  for (std::size_t i = decision_channels * decision_scales; i < decision_inputs; ++i) {
    EvidenceModel model = none;
    flat(model.curve[i]);
    EXPECT_NEAR(evidence_contributions(model, {}, {}).offset, 2.5, 1e-6);
  }
}

TEST(Contributions, OfAnEstimatorFollowTheWheelThatIsLifted) {
  EvidenceCurves estimator(test::lifted_curves());
  EXPECT_TRUE(std::isnan(estimator.evidence().contributions[0].load));
  const auto run = test::lifted_run(2, 2);
  std::array<double, 2> standing{}, lifted{};
  std::array<int, 2> standing_steps{}, lifted_steps{};
  for (std::size_t k = 0; k < run.signals.size(); ++k) {
    estimator.update(run.signals[k]);
    const Evidence evidence = estimator.evidence();
    for (std::size_t side = 0; side < 2; ++side) {
      const bool contact = run.contact[side][k] != 0;
      (contact ? standing : lifted)[side] += evidence.contributions[side].load;
      ++(contact ? standing_steps : lifted_steps)[side];
    }
  }
  for (std::size_t side = 0; side < 2; ++side) {
    EXPECT_GT(standing[side] / standing_steps[side], lifted[side] / lifted_steps[side] + 2.0);
  }
  estimator.reset();
  EXPECT_TRUE(std::isnan(estimator.evidence().contributions[1].load));
}

TEST(Contributions, OfALegWithoutSignalsAreUnknown) {
  EvidenceCurves estimator(test::lifted_curves());
  auto run = test::lifted_run(1, 2);
  Signals& broken = run.signals[50];
  broken.leg[1].knee.torque = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t k = 0; k <= 50; ++k) estimator.update(run.signals[k]);
  EXPECT_FALSE(std::isnan(estimator.evidence().contributions[0].load));
  EXPECT_TRUE(std::isnan(estimator.evidence().contributions[1].load));
}

}  // namespace
}  // namespace touchdown
