#include "estimator/decision/fit.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "estimator/decision/feature_extractor.hpp"
#include "tests/estimator/decision/lifted_run.hpp"

namespace touchdown {
namespace {

/// A fit to every step, without augmentation.
DecisionFitConfig undisturbed() {
  DecisionFitConfig fit{.passes = 1, .rows = 1'000'000, .share_with_resets = 0.0};
  fit.augmentation = {.largest_torque_noise = 0.0,
                      .largest_acceleration_noise = 0.0,
                      .torque_bias = 0.0,
                      .position_bias = 0.0,
                      .gain_error = 0.0};
  return fit;
}

TEST(DecisionRows, EndWhenTheyAreAskedToStop) {
  struct Enough {};
  const test::CarriedRun run = test::lifted_run(1, 3);
  EXPECT_THROW((void)decision_rows(std::vector<LabelledRun>{run.view()}, {}, undisturbed(),
                                   [] { throw Enough(); }),
               Enough);
}

TEST(DecisionRows, OfSlowPassesMatchTheInputsOfASlowRobot) {
  const test::CarriedRun run = test::lifted_run(1, 3);
  for (const std::size_t interval : {1U, 5U}) {
    DecisionFitConfig fit = undisturbed();
    fit.steps_of_slow = 5;
    fit.share_slow = interval == 5 ? 1.0 : 0.0;
    const DecisionRows rows = decision_rows(std::vector<LabelledRun>{run.view()}, {}, fit);
    FeatureExtractor features({.sample_rate = 1000.0 / static_cast<double>(interval)});
    Eigen::Index row = 0;
    for (std::size_t k = 0; k < run.signals.size(); k += interval) {
      features.update(run.signals[k]);
      features.compute_inputs();
      for (std::size_t side = 0; side < 2; ++side, ++row) {
        ASSERT_LT(row, rows.count());
        ASSERT_EQ(rows.is_contact[row], run.contact[side][k] != 0 ? 1.0F : 0.0F);
        ASSERT_EQ(rows.inputs_of(row), features.inputs(side)) << k << ", wheel " << side;
      }
    }
    EXPECT_EQ(row, rows.count());
    EXPECT_EQ(2 * rows.inputs.cols(), rows.count());  // both wheels share a column
  }
}

TEST(DecisionRows, KeepTheWheelThatIsValid) {
  test::CarriedRun run = test::lifted_run(1, 3);
  for (std::size_t k = 0; k < run.signals.size(); ++k) {
    if (k % 3 == 1) run.signals[k].leg[0].knee.torque = std::nan("");
    if (k % 3 == 2) run.signals[k].leg[1].hip.position = std::nan("");
  }
  DecisionFitConfig fit = undisturbed();
  fit.share_slow = 0.0;
  const DecisionRows rows = decision_rows(std::vector<LabelledRun>{run.view()}, {}, fit);
  FeatureExtractor features({});
  Eigen::Index row = 0;
  for (std::size_t k = 0; k < run.signals.size(); ++k) {
    const FeatureExtractor::Step step = features.update(run.signals[k]);
    features.compute_inputs();
    for (std::size_t side = 0; side < 2; ++side) {
      if (!step.is_valid[side]) continue;
      ASSERT_LT(row, rows.count());
      ASSERT_EQ(rows.inputs_of(row), features.inputs(side)) << k << ", wheel " << side;
      ASSERT_EQ(rows.is_contact[row], run.contact[side][k] != 0 ? 1.0F : 0.0F);
      ++row;
    }
  }
  EXPECT_EQ(row, rows.count());
  EXPECT_LT(rows.count(), 2 * static_cast<Eigen::Index>(run.signals.size()));
}

TEST(DecisionRows, ContainRandomStateResets) {
  test::CarriedRun run;  // loads that always change
  for (int k = 0; k < 20'000; ++k) {
    run.add(20.0 + 0.001 * k, 30.0 - 0.0005 * k, 0.001 * (k % 7));
    run.label(k % 2 == 0, true);
  }
  DecisionFitConfig fit = undisturbed();
  fit.share_slow = 0.0;
  fit.share_with_resets = 1.0;
  fit.reset_after = 0.05;
  const DecisionRows rows = decision_rows(std::vector<LabelledRun>{run.view()}, {}, fit);
  ASSERT_EQ(rows.inputs.cols(), 20'000);
  int resets = 0;
  for (Eigen::Index i = 0; i < rows.inputs.cols(); ++i) {  // the left wheel's load, all scales
    const auto load = rows.inputs.col(i).head(static_cast<Eigen::Index>(decision_scales));
    resets += (load.array() == load[0]).all() ? 1 : 0;
  }
  EXPECT_NEAR(resets, 20.0 / 0.05, 5.0 * std::sqrt(20.0 / 0.05));
}

TEST(DecisionFitConfig, RefusesInvalidSharesAndTimes) {
  for (const double share : {-0.1, 1.1, std::nan("")}) {
    EXPECT_THROW(check_decision_fit_config({.share_slow = share}), InputError) << share;
  }
  EXPECT_THROW(check_decision_fit_config({.steps_of_slow = 0}), InputError);
  for (const double share : {-0.1, 1.1, std::nan("")}) {
    EXPECT_THROW(check_decision_fit_config({.share_with_resets = share}), InputError) << share;
  }
  for (const double after : {0.0, -1.0, std::nan("")}) {
    EXPECT_THROW(check_decision_fit_config({.reset_after = after}), InputError) << after;
  }
  EXPECT_THROW(check_decision_fit_config({.reset_after_noise = -0.1}), InputError);
}

}  // namespace
}  // namespace touchdown
