#include "estimator/evidence/filter.hpp"

#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "estimator/evidence/channels.hpp"
#include "estimator/evidence/fit.hpp"
#include "tests/estimator/evidence/lifted_curves.hpp"
#include "tests/estimator/evidence/random_curves.hpp"

namespace touchdown {
namespace {

using test::brief_fit;
using test::lifted_curves;

TEST(EvidenceCurves, LearnToTellWheelsThatCarryFromThoseThatDoNot) {
  for (const bool with_pairs : {false, true}) {
    EvidenceCurves estimator(lifted_curves(with_pairs));
    EXPECT_GT(test::share_right(estimator, test::lifted_run(2, 2)), 0.99) << with_pairs;
    EvidenceCurves in_noise(lifted_curves(with_pairs));
    EXPECT_GT(test::share_right(in_noise, test::lifted_run(2, 3, 0.5)), 0.95) << with_pairs;
  }
}

TEST(EvidenceCurves, SayThatMoreLoadSpeaksForContact) {
  const EvidenceModel& model = lifted_curves(false);
  DecisionInputs none{};
  DecisionInputs carries{};
  for (std::size_t scale = 0; scale < decision_scales; ++scale) {
    carries[scale] = static_cast<float>(compressed(26.0, 5.0));
  }
  EXPECT_GT(evidence_logit(model, carries), evidence_logit(model, none) + 3.0F);
}

TEST(EvidenceCurves, BelieveOfTheMirroredRobotWhatTheyBelievedOfTheOtherWheel) {
  EvidenceCurves estimator(lifted_curves());
  EvidenceCurves mirror(lifted_curves());
  double largest = 0.0;
  for (const Signals& s : test::lifted_run(1, 5, 0.3).signals) {
    const Belief belief = estimator.update(s);
    const Belief& mirrored = mirror.update(test::in_the_mirror(s));
    for (std::size_t side = 0; side < 2; ++side) {
      ASSERT_NEAR(mirrored.wheel[side].p_contact, belief.wheel[1 - side].p_contact, 1e-4);
    }
    largest = std::max(largest, std::abs(belief.wheel[0].p_contact - belief.wheel[1].p_contact));
  }
  EXPECT_GT(largest, 0.9);  // the wheels were told apart
}

TEST(EvidenceCurves, MeanTheirProbabilityWhateverTheirClassesWeigh) {
  test::Normal normal(7);
  const test::CarriedRun seen = test::overlapping_loads(normal);
  const test::CarriedRun others = test::overlapping_loads(normal);
  for (const double exponent : {0.0, -1.0}) {
    EvidenceFitConfig config = brief_fit(false);
    config.descent.passes = 1;
    config.descent.class_exponent = exponent;
    config.descent.disturbance.largest_torque_noise = 0.0;
    config.descent.disturbance.largest_acceleration_noise = 0.0;
    config.descent.disturbance.torque_bias = config.descent.disturbance.gain_error = 0.0;
    EvidenceCurves estimator(fit_evidence_model(std::vector<LabelledRun>{seen.view()}, {}, config),
                             {.smoothing = 0.0});
    double believed = 0.0;
    for (std::size_t k = 0; k < others.signals.size(); ++k) {
      believed += estimator.update(others.signals[k]).wheel[0].p_contact -
                  (others.contact[0][k] != 0 ? 1.0 : 0.0);
    }
    EXPECT_NEAR(believed / static_cast<double>(others.signals.size()), 0.0, 0.03) << exponent;
  }
}

TEST(EvidenceCurves, RelaxWithoutALegAndWithoutAnImuAndSayWhy) {
  EvidenceCurves estimator(lifted_curves());
  test::CarriedRun run = test::lifted_run(1, 8);
  Signals s;
  for (std::size_t k = 0; k < 250; ++k) estimator.update(s = run.signals[k]);
  Belief belief;
  const auto wait = [&](auto fault) {
    for (int k = 0; k < 1000; ++k) {
      s.time += 0.001;
      s.vertical_acceleration = 1e-3 * (k % 3);
      for (LegSignals& leg : s.leg) leg.wheel.position += 1e-3;  // what moves is not frozen
      s.angular_velocity.y() += 1e-6;
      Signals heard = s;
      fault(heard);
      belief = estimator.update(heard);
    }
  };
  wait([](Signals& heard) { heard.leg[1].knee.torque = std::nan(""); });
  EXPECT_EQ(belief.status, SignalStatus::invalid);
  EXPECT_GT(belief.wheel[0].p_contact, 0.95);
  EXPECT_NEAR(belief.wheel[1].p_contact, 0.5, 0.01);
  EXPECT_TRUE(belief.wheel[1].contact);  // the last decision
  wait([](Signals& heard) { heard.angular_velocity.x() = std::nan(""); });
  EXPECT_NEAR(belief.wheel[0].p_contact, 0.5, 0.01);
  wait([](Signals&) {});
  EXPECT_EQ(belief.status, SignalStatus::good);
  EXPECT_GT(belief.wheel[1].p_contact, 0.95);
  estimator.reset();
  EXPECT_EQ(estimator.update(s).status, SignalStatus::good);
}

TEST(EvidenceCurves, AreNeverLostWhateverTheyHear) {
  EvidenceCurves estimator(test::random_curves(3));
  test::expect_never_lost(estimator);
}

TEST(EvidenceCurves, RefuseWhatMakesNoSense) {
  EXPECT_THROW((EvidenceCurves{EvidenceModel(), {.sample_rate = 0.0}}), InputError);
  EvidenceModel broken;
  broken.curve[0][0] = std::nanf("");
  EXPECT_THROW(EvidenceCurves{broken}, InputError);
  EXPECT_THROW(static_cast<void>(fit_evidence_model({}, {}, brief_fit(false))), InputError);
  test::CarriedRun standing = test::lifted_run(1, 10);
  for (auto& wheel : standing.contact) wheel.assign(wheel.size(), 1);
  EXPECT_THROW(static_cast<void>(fit_evidence_model(std::vector<LabelledRun>{standing.view()}, {},
                                                    brief_fit(false))),
               InputError);
}

}  // namespace
}  // namespace touchdown
