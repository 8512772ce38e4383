#include "estimator/evidence/filter.hpp"

#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "estimator/evidence/channels.hpp"
#include "estimator/evidence/fit.hpp"
#include "tests/estimator/evidence/lifted_curves.hpp"

namespace touchdown {
namespace {

using test::brief_fit;
using test::lifted_curves;

TEST(EvidenceCurves, LearnWhichWheelsCarryALoad) {
  EvidenceCurves estimator(lifted_curves());
  EXPECT_GT(test::accuracy(estimator, test::lifted_run(2, 2)), 0.99);
  EvidenceCurves in_noise(lifted_curves());
  EXPECT_GT(test::accuracy(in_noise, test::lifted_run(2, 3, 0.5)), 0.95);
}

TEST(EvidenceCurves, GiveMoreEvidenceForContactUnderMoreLoad) {
  const EvidenceModel& model = lifted_curves();
  DecisionInputs none{};
  DecisionInputs carries{};
  for (std::size_t scale = 0; scale < decision_scales; ++scale) {
    carries[scale] = static_cast<float>(compressed(26.0, 5.0));
  }
  EXPECT_GT(evidence_logit(model, carries), evidence_logit(model, none) + 3.0F);
}

TEST(EvidenceCurves, SwapBeliefsForTheMirroredRobot) {
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
  EXPECT_GT(largest, 0.9);  // the wheels were distinguished
}

TEST(EvidenceCurves, AreCalibratedForAnyClassWeights) {
  test::Normal normal(7);
  const test::CarriedRun fitted = test::overlapping_loads(normal);
  const test::CarriedRun others = test::overlapping_loads(normal);
  for (const double exponent : {0.0, -1.0}) {
    EvidenceFitConfig config = brief_fit();
    config.descent.passes = 1;
    config.descent.class_exponent = exponent;
    config.descent.augmentation.largest_torque_noise = 0.0;
    config.descent.augmentation.largest_acceleration_noise = 0.0;
    config.descent.augmentation.torque_bias = config.descent.augmentation.gain_error = 0.0;
    EvidenceCurves estimator(
        fit_evidence_model(std::vector<LabelledRun>{fitted.view()}, {}, config),
        {.smoothing = 0.0});
    double bias = 0.0;
    for (std::size_t k = 0; k < others.signals.size(); ++k) {
      bias += estimator.update(others.signals[k]).wheel[0].p_contact -
              (others.contact[0][k] != 0 ? 1.0 : 0.0);
    }
    EXPECT_NEAR(bias / static_cast<double>(others.signals.size()), 0.0, 0.03) << exponent;
  }
}

TEST(EvidenceCurves, RefuseInvalidValues) {
  EXPECT_THROW((EvidenceCurves{EvidenceModel(), {.sample_rate = 0.0}}), InputError);
  EvidenceModel broken;
  broken.curve[0][0] = std::nanf("");
  EXPECT_THROW(EvidenceCurves{broken}, InputError);
  EXPECT_THROW(static_cast<void>(fit_evidence_model({}, {}, brief_fit())), InputError);
  test::CarriedRun standing = test::lifted_run(1, 10);
  for (auto& wheel : standing.contact) wheel.assign(wheel.size(), 1);
  EXPECT_THROW(static_cast<void>(
                   fit_evidence_model(std::vector<LabelledRun>{standing.view()}, {}, brief_fit())),
               InputError);
}

}  // namespace
}  // namespace touchdown
