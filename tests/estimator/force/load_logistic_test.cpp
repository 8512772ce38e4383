#include "estimator/force/load_logistic.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "estimator/force/load_logistic_fit.hpp"
#include "tests/estimator/force/carried_run.hpp"
#include "tests/estimator/random.hpp"

namespace touchdown {
namespace {

constexpr LogisticCurve at_ten = {.slope = 0.5, .intercept = -5.0};  // even chance at 10 N

/// Loads of 0 to 20 N with contacts drawn with the probability of a curve.
test::CarriedRun drawn(const LogisticCurve& curve, int steps) {
  test::CarriedRun run;
  test::Normal normal(5);
  const auto uniform = [&] { return 0.5 * std::erfc(-normal() / std::sqrt(2.0)); };
  for (int i = 0; i < steps; ++i) {
    const double left = 20.0 * uniform();
    const double right = 20.0 * uniform();
    run.add(left, right);
    run.label(uniform() < curve(left), uniform() < curve(right));
  }
  return run;
}

TEST(LoadLogistic, FindsTheCurveBehindTheLabels) {
  const test::CarriedRun run = drawn(at_ten, 10'000);
  const std::vector<LabelledRun> runs = {run.view()};
  const LogisticCurve curve = fit_load_logistic(runs, {.low_pass = 0.0});
  EXPECT_NEAR(curve.slope, at_ten.slope, 0.02);
  EXPECT_NEAR(-curve.intercept / curve.slope, 10.0, 0.15);
}

TEST(LoadLogistic, IsFittedToMeasuredSteps) {
  // The classes are far apart, but the curve stays finite. Skipped and unmeasured steps do not
  // count.
  test::CarriedRun run;
  for (int i = 0; i < 3000; ++i) {
    const bool wrong = i < 100;
    const bool in_contact = i % 1000 < 500;
    run.add(in_contact ? 26.0 : 0.0, in_contact ? 26.0 : 0.0);
    if (i % 7 == 0) run.signals.back().leg[0].knee.torque = std::nan("");
    run.label(in_contact != wrong, in_contact != wrong);
  }
  LabelledRun view = run.view();
  view.skip = 100;
  const LogisticCurve curve = fit_load_logistic(std::vector<LabelledRun>{view});
  EXPECT_TRUE(std::isfinite(curve.slope) && curve.slope > 0.0);
  EXPECT_GT(curve(26.0), 0.95);
  EXPECT_LT(curve(0.0), 0.05);
}

TEST(LoadLogistic, NeedsBothClassesAndALabelForEveryStep) {
  test::CarriedRun run;
  for (int i = 0; i < 100; ++i) run.add(26.0, 26.0);
  EXPECT_THROW(static_cast<void>(fit_load_logistic(std::vector<LabelledRun>{run.view()})),
               InputError);
  EXPECT_THROW(static_cast<void>(fit_load_logistic({})), InputError);
  run.label(true, true);
  run.contact[1].pop_back();
  EXPECT_THROW(static_cast<void>(fit_load_logistic(std::vector<LabelledRun>{run.view()})),
               InputError);
}

TEST(LoadLogistic, AppliesItsCurveToEachWheelsLoad) {
  LoadLogistic estimator(at_ten, {.low_pass = 0.0});
  test::CarriedRun run;
  const Belief& belief = estimator.update(run.add(12.0, 3.0));
  EXPECT_NEAR(belief.wheel[0].p_contact, 1.0 / (1.0 + std::exp(-1.0)), 1e-9);
  EXPECT_NEAR(belief.wheel[1].p_contact, 1.0 / (1.0 + std::exp(3.5)), 1e-9);
  EXPECT_TRUE(belief.wheel[0].contact);
  EXPECT_FALSE(belief.wheel[1].contact);
  EXPECT_EQ(belief.p_both_wheels, belief.wheel[0].p_contact * belief.wheel[1].p_contact);
}

TEST(LoadLogistic, LowPassesTheForce) {
  LoadLogistic estimator(at_ten, {.low_pass = 0.01});
  test::CarriedRun run;
  estimator.update(run.add(0.0, 0.0));
  for (int i = 0; i < 10; ++i) estimator.update(run.add(20.0, 20.0));
  const double expected = 20.0 * (1.0 - std::exp(-1.0));  // one time constant later
  EXPECT_NEAR(estimator.update(run.signals.back()).wheel[0].p_contact, at_ten(expected), 0.1);
}

TEST(LoadLogistic, RelaxesForALegWithoutSignals) {
  LoadLogistic estimator(at_ten);
  test::CarriedRun run;
  for (int i = 0; i < 100; ++i) estimator.update(run.add(26.0, 26.0));
  for (const double bad : {std::nan(""), HUGE_VAL, 1e9}) {
    Belief belief;
    for (int i = 0; i < 1000; ++i) {
      Signals& s = run.add(26.0, 26.0);
      s.leg[1].hip.torque = bad;
      belief = estimator.update(s);
    }
    EXPECT_EQ(belief.status, SignalStatus::invalid);
    EXPECT_GT(belief.wheel[0].p_contact, 0.99);
    EXPECT_NEAR(belief.wheel[1].p_contact, 0.5, 0.01);
    EXPECT_TRUE(belief.wheel[1].contact);  // the last decision
    EXPECT_EQ(estimator.update(run.add(26.0, 26.0)).status, SignalStatus::good);
  }
  estimator.reset();
  EXPECT_EQ(estimator.update(Signals()).wheel[0].p_contact, 0.5);  // straight legs give no evidence
}

TEST(LoadLogistic, RecoversSoonFromTheForceOfAStraightKnee) {
  LoadLogistic estimator(at_ten);
  test::CarriedRun run;
  for (int i = 0; i < 100; ++i) estimator.update(run.add(0.0, 0.0));
  Signals straight = run.signals.back();
  straight.time += 0.001;
  straight.leg[0].knee.position = -1e-7;
  straight.leg[0].knee.torque = 1.0;
  estimator.update(straight);
  Belief belief;
  run.add(0.0, 0.0);
  for (int i = 0; i < 50; ++i) belief = estimator.update(run.add(0.0, 0.0));
  EXPECT_FALSE(belief.wheel[0].contact);
}

TEST(LoadLogistic, RefusesInvalidValues) {
  const auto refused = [](const LogisticCurve& curve, const LoadLogisticConfig& config) {
    EXPECT_THROW((LoadLogistic{curve, config}), InputError);
  };
  refused({std::numeric_limits<double>::quiet_NaN(), 0.0}, {});
  refused({1.0, std::numeric_limits<double>::infinity()}, {});
  refused(at_ten, {.sample_rate = 0.0});
  refused(at_ten, {.low_pass = -1.0});
  refused(at_ten, {.largest_force = 0.0});
  refused(at_ten, {.threshold = 1.0});
  refused(at_ten, {.geometry = {.lower_length = 0.0}});
}

}  // namespace
}  // namespace touchdown
