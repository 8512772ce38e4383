#include <limits>

#include <gtest/gtest.h>

#include "experiments/estimators/fits.hpp"
#include "experiments/evaluation/tasks.hpp"
#include "experiments/fitting/fitting.hpp"
#include "tests/experiments/synthetic_runs.hpp"

namespace touchdown::experiments {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Counts its updates. It reports contact after an odd number of updates.
class Counter : public ContactEstimator {
 public:
  void reset() noexcept override { belief_ = {}, updates_ = 0; }

 private:
  const Belief& estimate(const Signals& /*signals*/) noexcept override {
    ++updates_;
    belief_.wheel[0].contact = updates_ % 2 == 1;
    belief_.wheel[0].p_contact = 1e-3 * updates_;
    return belief_;
  }

  Belief belief_;
  int updates_ = 0;
};

Signals no_record() {
  Signals signals;
  signals.time = signals.vertical_acceleration = nan;
  signals.linear_acceleration.setConstant(nan);
  signals.angular_velocity.setConstant(nan);
  signals.leg.fill({{nan, nan, nan}, {nan, nan, nan}, {nan, nan, nan}});
  return signals;
}

/// Six steps of which the first, the fourth and the fifth have no record.
RunSignals with_gaps() {
  RunSignals run = synthetic_run(3, 6);
  for (const std::size_t k : {0U, 3U, 4U}) run.signals[k] = no_record();
  return run;
}

TEST(MissingRecords, AreSkippedAndTheLastBeliefHolds) {
  const RunSignals run = with_gaps();
  const NoiseRun noise = noise_run(run, {1, 2});
  Counter counter;
  const auto decided = decide(counter, run, noise, {});
  EXPECT_EQ(decided[0], (scoring::ContactSequence{0, 1, 0, 0, 0, 1}));
  const scoring::Prediction prediction = predict(counter, run, noise, {});
  EXPECT_EQ(prediction[0].p_contact, (std::vector{0.5, 0.001, 0.002, 0.002, 0.002, 0.003}));
}

TEST(MissingRecords, SkipLabelsOfTheOracle) {
  RunSignals run = synthetic_run(3);
  for (std::size_t k = 620; k < 650; ++k) run.signals[k] = no_record();
  const NoiseRun noise = noise_run(run, {1, 2});
  const auto oracle = make_estimator({}, {"mujoco", "mujoco", "oracle"}, {}, run);
  const auto decided = decide(*oracle, run, noise, {});
  EXPECT_EQ(decided[0], run.contact[0]);
  EXPECT_EQ(decided[1], run.contact[1]);
}

TEST(MissingRecords, PreventBatches) {
  const std::vector<noise::SensorNoise> levels(1);
  EXPECT_TRUE(needs_no_guard(synthetic_run(3, 6), levels));
  EXPECT_FALSE(needs_no_guard(with_gaps(), levels));
}

TEST(MissingRecords, AndNanTorquesAreLeftOutOfMeasurementFits) {
  RunSignals run = synthetic_run(first_fit_run);
  run.signals[1500] = no_record();
  run.signals[2650].leg[1].knee.torque = nan;
  MeasurementConfig config;
  config.torque.low_pass = 0.0;
  const MeasurementModel with = fit_torques(RunPointers{&run}, 0.3, config);
  std::vector<TorqueSample> contact, no_contact;
  for (std::size_t leg = 0; leg < 2; ++leg) {
    TorqueChannel channel(config.torque, static_cast<Side>(leg), 1000.0);
    const std::size_t skip = scoring::first_scored_step(1000, {});
    for (std::size_t k = skip; k < run.steps(); ++k) {
      if (k == 1500 || (leg == 1 && k == 2650)) continue;
      (run.contact[leg][k] != 0 ? contact : no_contact)
          .push_back(channel.update(run.signals[k].leg[leg]));
    }
  }
  const MeasurementModel without = fit_measurement_model(contact, no_contact, config.fit);
  for (const TorqueSample sample : {TorqueSample{1.3, 0.3}, {0.1, 0.02}, {0.6, 0.1}}) {
    EXPECT_EQ(with(sample).contact, without(sample).contact);
    EXPECT_EQ(with(sample).no_contact, without(sample).no_contact);
  }
}

}  // namespace
}  // namespace touchdown::experiments
