#include "experiments/submissions/export.hpp"

#include <cstring>
#include <limits>

#include <gtest/gtest.h>

#include "tests/experiments/synthetic_runs.hpp"

namespace touchdown::experiments {
namespace {

/// Stores its inputs.
class RecordingEstimator : public ContactEstimator {
 public:
  void reset() noexcept override { inputs.clear(); }
  std::vector<Signals> inputs;

 private:
  const Belief& estimate(const Signals& signals) noexcept override {
    inputs.push_back(signals);
    return belief_;
  }

  Belief belief_;
};

std::uint64_t bits(double value) {
  std::uint64_t result = 0;
  std::memcpy(&result, &value, sizeof value);
  return result;
}

/// A run with all numbers different, and two steps without a record.
RunSignals run_with_gaps() {
  RunSignals run = synthetic_run(3, 600);
  for (std::size_t k = 0; k < run.steps(); ++k) {
    Signals& signals = run.signals[k];
    const double x = static_cast<double>(k) / 7.0;
    signals.angular_velocity = {x, x + 0.1, x + 0.2};
    signals.ground_velocity_command = -x;
    for (LegSignals& leg : signals.leg) {
      leg.hip = {x + 1.0, x + 2.0, x + 3.0};
      leg.knee.position = x + 4.0;
      leg.knee.velocity = x + 5.0;
    }
  }
  for (const std::size_t k : {100U, 101U}) {
    run.signals[k].time = run.signals[k].vertical_acceleration =
        std::numeric_limits<double>::quiet_NaN();
  }
  return run;
}

/// Expects the numbers of a step in the documented order.
void expect_step(const ModelArrays& arrays, std::size_t step, const Signals& signals) {
  const auto expect = [&](const char* name, std::size_t column, double value) {
    const ModelArray& array = arrays.at(name);
    ASSERT_EQ(bits(array.data.at(step * array.columns() + column)), bits(value))
        << name << " at " << step;
  };
  expect("time", 0, signals.time);
  expect("has_record", 0, 1.0);
  std::size_t column = 0;
  for (const LegSignals& leg : signals.leg) {
    for (const JointSignals& joint : {leg.hip, leg.knee, leg.wheel}) {
      expect("position", column, joint.position);
      expect("velocity", column, joint.velocity);
      expect("torque", column++, joint.torque);
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    expect("linear_acceleration", i, signals.linear_acceleration[axis]);
    expect("angular_velocity", i, signals.angular_velocity[axis]);
  }
  expect("vertical_acceleration", 0, signals.vertical_acceleration);
  expect("ground_velocity_command", 0, signals.ground_velocity_command);
}

TEST(ExportedArrays, EqualTheInputsOfEstimatorsBitForBit) {
  const RunSignals run = run_with_gaps();
  const NoiseRun noise = noise_run(run, {.seed = 5, .run = 3});
  const noise::SensorNoise levels{.knee_torque = 0.7,
                                  .wheel_torque = 0.3,
                                  .acceleration = 2.0,
                                  .joint_position = 0.01,
                                  .joint_velocity = 0.1,
                                  .hip_torque = 0.9};
  RecordingEstimator estimator;
  static_cast<void>(predict(estimator, run, noise, levels));
  const ModelArrays arrays = exported_arrays(run, noise, levels);
  ASSERT_EQ(estimator.inputs.size(), run.steps() - 2);
  std::size_t next = 0;
  for (std::size_t k = 0; k < run.steps(); ++k) {
    if (k != 100 && k != 101) expect_step(arrays, k, estimator.inputs[next++]);
  }
}

TEST(ExportedArrays, OfFittedRunsAreWithoutNoise) {
  const RunSignals run = synthetic_run(1, 50);
  const ModelArrays arrays = exported_arrays(run);
  for (std::size_t k = 0; k < run.steps(); ++k) expect_step(arrays, k, run.signals[k]);
}

TEST(ExportedArrays, MarkStepsWithoutARecordAndGiveTheirTimes) {
  const ModelArrays arrays = exported_arrays(run_with_gaps());
  EXPECT_EQ(arrays.at("has_record").data[99], 1.0);
  EXPECT_EQ(arrays.at("has_record").data[100], 0.0);
  EXPECT_DOUBLE_EQ(arrays.at("time").data[100], 0.1);
  EXPECT_TRUE(std::isnan(arrays.at("vertical_acceleration").data[100]));
}

TEST(ExportedArrays, HaveALabelForEachWheel) {
  const RunSignals run = synthetic_run(1, 1000);
  const ModelArray contact = exported_arrays(run).at("contact");
  ASSERT_EQ(contact.shape, (std::vector<std::size_t>{1000, 2}));
  EXPECT_EQ(contact.data[2 * 603], 0.0);      // the left wheel is in the air first
  EXPECT_EQ(contact.data[2 * 603 + 1], 1.0);  // the right one lags
  EXPECT_EQ(contact.data[2 * 700 + 1], 0.0);
}

TEST(ExportedArrays, AreNoLargerThanTheirBound) {
  const RunSignals run = run_with_gaps();
  const NoiseRun noise = noise_run(run, {.seed = 5, .run = 3});
  const ModelArrays arrays = exported_arrays(run, noise, {.acceleration = 1.0});
  EXPECT_LE(static_cast<double>(to_npz(arrays, "a.npz", Deflated::all).size()),
            bytes_of_exported(static_cast<double>(run.steps())));
}

TEST(Sha256, IsThatOfTheStandardsExamples) {
  // NIST, Cryptographic Standards and Guidelines, examples of SHA-256.
  EXPECT_EQ(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(sha256(std::string(1'000'000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

}  // namespace
}  // namespace touchdown::experiments
