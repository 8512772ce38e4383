#include "experiments/oracle.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "experiments/estimator_registry.hpp"
#include "experiments/heard_run.hpp"
#include "experiments/listening.hpp"
#include "synthetic_runs.hpp"

namespace touchdown {
namespace {

TEST(Oracle, ScoresPerfectlyByNameWhateverTheNoise) {
  const Experiment experiment = synthetic_experiment({"oracle"});
  const HeardRun run = synthetic_run(3);
  const UnitNoise noise = unit_noise(run, noise_key(experiment, 0, 3));
  const std::vector<Condition> conditions = {{"mujoco", "mujoco", "oracle"}};
  const auto counts = sweep_run(conditions, noise_cells(experiment.noise), run, noise, {},
                                experiment.scoring, [] { return true; });
  ASSERT_FALSE(counts.empty());
  for (const Classification& c : counts) {
    EXPECT_GT(c.flight(), 0);
    EXPECT_EQ(c.success(), 1.0);
  }
  const auto estimator = make_estimator(conditions[0], {}, 1000);
  const auto scores = score(run.contact, predict(*estimator, run, noise, {.acceleration = 8.0}),
                            run.pieces, 1000, experiment.scoring);
  std::int64_t detected = 0;
  for (const RobotScore& robot : scores) {
    for (const Score& view : robot.view) {
      EXPECT_EQ(view.points.success(), 1.0);
      EXPECT_EQ(view.takeoff.events - view.takeoff.detected + view.takeoff.false_alarms, 0);
      EXPECT_EQ(view.landing.events - view.landing.detected + view.landing.false_alarms, 0);
      EXPECT_EQ(view.calibration.brier(), 0.0);
      detected += view.takeoff.detected;
    }
  }
  EXPECT_GT(detected, 0);
}

TEST(Oracle, KnowsWhenOneWheelTouches) {
  Oracle oracle;
  oracle.tell({ContactSequence{1, 0, 0}, ContactSequence{1, 1, 0}});
  EXPECT_EQ(oracle.update({}).p_both_wheels, 1.0);
  const Belief one = oracle.update({});
  EXPECT_FALSE(one.wheel[0].contact);
  EXPECT_TRUE(one.wheel[1].contact);
  EXPECT_EQ(one.p_any_wheel, 1.0);
  EXPECT_EQ(one.p_both_wheels, 0.0);
  EXPECT_EQ(oracle.update({}).p_any_wheel, 0.0);
}

TEST(Oracle, BelievesThePriorWhereItWasToldNothing) {
  Oracle oracle;
  EXPECT_EQ(oracle.update({}).p_any_wheel, 0.5);
  oracle.tell({ContactSequence{1}, ContactSequence{1}});
  EXPECT_EQ(oracle.update({}).p_any_wheel, 1.0);
  EXPECT_EQ(oracle.update({}).p_any_wheel, 0.5);
  oracle.tell({ContactSequence{1}, ContactSequence{1}});
  oracle.reset();
  EXPECT_EQ(oracle.update({}).p_any_wheel, 0.5);
}

TEST(Oracle, IsTheOnlyOneThatHearsTheTruth) {
  HeardRun run = synthetic_run(3);
  const Experiment experiment = synthetic_experiment(estimator_names());
  const FittedModels models = fit_models(experiment, {synthetic_run(first_fit_run)});
  const UnitNoise noise = unit_noise(run, noise_key(experiment, 0, 3));
  HeardRun lied = run;
  for (ContactSequence& contact : lied.contact) {
    for (auto& touches : contact) touches = touches == 0 ? 1 : 0;
  }
  for (const std::string& name : estimator_names()) {
    const auto estimator = make_estimator({"mujoco", "mujoco", name}, models, 1000);
    const auto heard = decide(*estimator, run, noise, {});
    EXPECT_EQ(heard == decide(*estimator, lied, noise, {}), name != "oracle") << name;
  }
}

}  // namespace
}  // namespace touchdown
