#include "experiments/estimators/baselines.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "experiments/estimators/registry.hpp"
#include "experiments/evaluation/tasks.hpp"
#include "experiments/fitting/fitting.hpp"
#include "experiments/signals/run_signals.hpp"
#include "scoring/score.hpp"
#include "tests/experiments/synthetic_runs.hpp"

namespace touchdown::experiments {
namespace {

TEST(Oracle, ScoresPerfectlyForAllNoise) {
  const Experiment experiment = synthetic_experiment({"oracle"});
  const RunSignals run = synthetic_run(3);
  const NoiseRun noise = noise_run(run, noise_key(experiment, 0, 3));
  const std::vector<Condition> conditions = {{"mujoco", "mujoco", "oracle"}};
  const auto counts = sweep_run(conditions, noise::noise_cells(experiment.noise), run, noise, {},
                                experiment, [] { return true; });
  ASSERT_FALSE(counts.empty());
  for (const scoring::Classification& c : counts) {
    EXPECT_GT(c.flight(), 0);
    EXPECT_EQ(c.success(), 1.0);
  }
  const auto estimator = make_estimator(experiment, conditions[0], {}, run);
  const auto scores =
      scoring::score(run.contact, predict(*estimator, run, noise, {.acceleration = 8.0}),
                     run.segments, 1000, experiment.scoring);
  std::int64_t detected = 0;
  for (const scoring::RobotScore& robot : scores) {
    for (const scoring::Score& view : robot.view) {
      EXPECT_EQ(view.points.success(), 1.0);
      EXPECT_EQ(view.takeoff.events - view.takeoff.detected + view.takeoff.false_alarms, 0);
      EXPECT_EQ(view.landing.events - view.landing.detected + view.landing.false_alarms, 0);
      EXPECT_EQ(view.calibration.brier(), 0.0);
      detected += view.takeoff.detected;
    }
  }
  EXPECT_GT(detected, 0);
}

TEST(Oracle, ReportsSingleWheelContact) {
  Oracle oracle({scoring::ContactSequence{1, 0, 0}, scoring::ContactSequence{1, 1, 0}});
  EXPECT_EQ(oracle.update({}).p_both_wheels, 1.0);
  const Belief one = oracle.update({});
  EXPECT_FALSE(one.wheel[0].contact);
  EXPECT_TRUE(one.wheel[1].contact);
  EXPECT_EQ(one.p_any_wheel, 1.0);
  EXPECT_EQ(one.p_both_wheels, 0.0);
  EXPECT_EQ(oracle.update({}).p_any_wheel, 0.0);
}

TEST(Oracle, ReportsThePriorWithoutLabels) {
  EXPECT_EQ(Oracle({}).update({}).p_any_wheel, 0.5);
  Oracle oracle({scoring::ContactSequence{1}, scoring::ContactSequence{1}});
  EXPECT_EQ(oracle.update({}).p_any_wheel, 1.0);
  EXPECT_EQ(oracle.update({}).p_any_wheel, 0.5);
  oracle.reset();
  EXPECT_EQ(oracle.update({}).p_any_wheel, 1.0);
}

TEST(Oracle, IsTheOnlyEstimatorThatUsesLabels) {
  RunSignals run = synthetic_run(3);
  const Experiment experiment = synthetic_experiment(estimator_names());
  const FittedModels models = fit_models(experiment, pointers_to({synthetic_run(first_fit_run)}));
  const NoiseRun noise = noise_run(run, noise_key(experiment, 0, 3));
  RunSignals inverted = run;
  for (scoring::ContactSequence& contact : inverted.contact) {
    for (auto& label : contact) label = label == 0 ? 1 : 0;
  }
  for (const std::string& name : estimator_names()) {
    const Condition condition = {"mujoco", "mujoco", name};
    const auto decided =
        decide(*make_estimator(experiment, condition, models, run), run, noise, {});
    EXPECT_EQ(decided == decide(*make_estimator(experiment, condition, models, inverted), inverted,
                                noise, {}),
              !estimator_entry(name).knows.truth)
        << name;
  }
}

}  // namespace
}  // namespace touchdown::experiments
