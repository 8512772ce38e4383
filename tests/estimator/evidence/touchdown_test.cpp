#include "estimator/evidence/touchdown.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "estimator/decision/filter.hpp"
#include "estimator/evidence/filter.hpp"
#include "estimator/evidence/touchdown_fit.hpp"
#include "tests/estimator/evidence/lifted_curves.hpp"
#include "tests/estimator/evidence/random_curves.hpp"

namespace touchdown {
namespace {

double log_odds(double p) { return std::log(p / (1.0 - p)); }

TEST(TouchdownEstimator, GivesTheMeanLogitOfCurvesAndNetwork) {
  const DecisionConfig config{.smoothing = 0.0};
  const TouchdownModel model = {test::lifted_curves(false), test::lifted_network()};
  TouchdownEstimator together(model, config);
  EvidenceCurves curves(model.evidence, config);
  DecisionNetwork network(model.network, config);
  int apart = 0;
  int compared = 0;
  for (const Signals& s : test::lifted_run(1, 3).signals) {
    const Belief& one = curves.update(s);
    const Belief& other = network.update(s);
    const Belief& mean = together.update(s);
    for (std::size_t side = 0; side < 2; ++side) {
      const double a = log_odds(one.wheel[side].p_contact);
      const double b = log_odds(other.wheel[side].p_contact);
      if (std::max(std::abs(a), std::abs(b)) > 20.0) continue;  // rounded to certainty
      ASSERT_NEAR(log_odds(mean.wheel[side].p_contact), 0.5 * (a + b), 1e-3);
      apart += std::abs(a - b) > 0.5 ? 1 : 0;
      ++compared;
    }
  }
  EXPECT_GT(compared, 3000);
  EXPECT_GT(apart, 300);  // their logits differ
}

TEST(TouchdownEstimator, IsFittedLikeCurvesAndNetworkAlone) {
  const test::CarriedRun run = test::lifted_run(1, 4);
  const std::vector<LabelledRun> runs = {run.view()};
  const DecisionFitConfig network{.passes = 1, .rows = 2000, .batch = 64, .epochs = 1};
  EvidenceFitConfig evidence;
  evidence.descent.passes = network.passes;
  evidence.descent.rows = network.rows;
  evidence.descent.batch = network.batch;
  evidence.descent.epochs = network.epochs;
  const TouchdownModel model = fit_touchdown_model(runs, {}, network, evidence);
  EXPECT_EQ(model.network, fit_decision_model(runs, {}, network));
  EXPECT_EQ(model.evidence, fit_evidence_model(runs, {}, evidence));
}

TEST(TouchdownEstimator, DistinguishesWheelsThatCarryALoad) {
  TouchdownEstimator estimator({test::lifted_curves(false), test::lifted_network()});
  EXPECT_GT(test::accuracy(estimator, test::lifted_run(2, 2)), 0.99);
  estimator.reset();
  EXPECT_GT(test::accuracy(estimator, test::lifted_run(2, 3, 0.5)), 0.95);
}

TEST(TouchdownEstimator, RefusesInvalidValues) {
  const TouchdownModel good = {test::random_curves(1, false), {}};
  EXPECT_NO_THROW(TouchdownEstimator{good});
  EXPECT_THROW((TouchdownEstimator{good, {.sample_rate = 0.0}}), InputError);
  TouchdownModel broken = good;
  broken.evidence.curve[0][0] = std::nanf("");
  EXPECT_THROW(TouchdownEstimator{broken}, InputError);
  broken = good;
  broken.network.last_bias = HUGE_VALF;
  EXPECT_THROW(TouchdownEstimator{broken}, InputError);
  EXPECT_THROW(static_cast<void>(fit_touchdown_model({})), InputError);
  EXPECT_THROW(static_cast<void>(fit_touchdown_model({}, {}, {}, {.smoothness = -1.0})),
               InputError);
}

}  // namespace
}  // namespace touchdown
