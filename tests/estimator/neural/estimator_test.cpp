#include "estimator/neural/estimator.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gmock/gmock.h>

#include "core/error.hpp"
#include "experiments/batch/neural.hpp"
#include "tests/estimator/neural/sample.hpp"

namespace touchdown {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

std::shared_ptr<const NeuralNetwork> network() {
  return test::shared(test::random_network(24, 16, 12));
}

/// Signals in which every input of the network changes.
std::vector<Signals> moving_robot(std::size_t steps, double rate = 1000.0) {
  test::Normal normal(5);
  std::vector<Signals> stream(steps);
  for (std::size_t k = 0; k < steps; ++k) {
    Signals& s = stream[k];
    s.time = static_cast<double>(k) / rate;
    for (int i = 0; i < 3; ++i) {
      s.linear_acceleration[i] = normal();
      s.angular_velocity[i] = normal();
    }
    s.vertical_acceleration = s.linear_acceleration.z();
    for (LegSignals& leg : s.leg) {
      for (JointSignals* joint : {&leg.hip, &leg.knee, &leg.wheel}) {
        *joint = {normal(), normal(), normal()};
      }
    }
    s.ground_velocity_command = normal();
  }
  return stream;
}

double logistic(float x) { return 1.0 / (1.0 + std::exp(-double{x})); }

TEST(NeuralInput, HasThePapersOrder) {
  Signals s;
  s.linear_acceleration = {1, 2, 3};
  s.angular_velocity = {4, 5, 6};
  s.leg[0] = {{7, 13, 99}, {8, 14, 99}, {0.5, 15, 99}};
  s.leg[1] = {{10, 16, 99}, {11, 17, 99}, {0.25 + 20 * std::numbers::pi, 18, 99}};
  s.ground_velocity_command = 19;
  const NeuralInput m = neural_input(s);
  for (int i = 0; i < neural_input_count; ++i) {
    const double expected = i == 8 ? std::sin(0.5) : i == 11 ? std::sin(0.25) : i + 1.0;
    EXPECT_NEAR(m[i], expected, 1e-6) << i;
  }
}

TEST(NeuralInputSampler, KeepsItsStepsWhereSamplesAreMissing) {
  const struct {
    std::vector<int> missing;
    std::vector<int> inputs;  ///< the samples that become inputs, every fifth
  } cases[] = {
      {{}, {0, 5, 10, 15, 20}},           {{3, 4, 6}, {0, 5, 10, 15, 20}},
      {{5}, {0, 6, 10, 15, 20}},          {{0, 1}, {2, 5, 10, 15, 20}},
      {{5, 6, 7, 8, 9}, {0, 10, 15, 20}}, {{4, 5, 6, 7, 8, 9, 10, 11, 12, 13}, {0, 14, 15, 20}},
      {{10, 15}, {0, 5, 11, 16, 20}},
  };
  for (const auto& [missing, expected] : cases) {
    NeuralInputSampler sampler(5);
    for (const int pass : {0, 1}) {
      std::vector<int> inputs;
      for (int k = 0; k < 24; ++k) {
        if (std::ranges::count(missing, k) > 0) {
          sampler.skip();
        } else if (sampler.add({})) {
          inputs.push_back(k);
        }
      }
      EXPECT_EQ(inputs, expected) << pass;
      sampler.reset();
    }
  }
}

TEST(NeuralEstimator, ActsEveryFiveMillisecondsAndHoldsInBetween) {
  const auto net = network();
  NeuralEstimator estimator(net);
  NeuralForward forward(net);
  const auto stream = moving_robot(200);
  double expected = 0.5;
  for (std::size_t k = 0; k < stream.size(); ++k) {
    if (k % 5 == 0) {
      // The measurement of a robot with 5 ms control steps: mean acceleration since the last step,
      // the command after it, all else now.
      Signals slow = stream[k];
      if (k > 0) {
        slow.linear_acceleration.setZero();
        for (std::size_t i = k - 4; i <= k; ++i) {
          slow.linear_acceleration += 0.2 * stream[i].linear_acceleration;
        }
        slow.ground_velocity_command = stream[k - 4].ground_velocity_command;
      }
      expected = logistic(forward.step(neural_input(slow))[0]);
    }
    const Belief& belief = estimator.update(stream[k]);
    ASSERT_NEAR(belief.p_any_wheel, expected, 1e-6) << k;
    ASSERT_EQ(belief.wheel[0].p_contact, belief.wheel[1].p_contact);
    ASSERT_EQ(belief.p_both_wheels, belief.p_any_wheel);
    ASSERT_EQ(belief.wheel[0].contact, belief.p_any_wheel >= 0.8);
    ASSERT_EQ(belief.status, SignalStatus::good);
  }
}

TEST(NeuralEstimator, AtItsOwnRateUsesEverySampleUnchanged) {
  const auto net = network();
  NeuralEstimator estimator(net, {.sample_rate = 200.0, .threshold = 0.8, .guard = {}});
  NeuralForward forward(net);
  for (const Signals& s : moving_robot(100, 200.0)) {
    const auto& output = forward.step(neural_input(s));
    ASSERT_NEAR(estimator.update(s).p_any_wheel, logistic(output[0]), 1e-7);
    ASSERT_NEAR(estimator.body_velocity().y(), output[2], 1e-6);
  }
}

TEST(NeuralEstimator, StartsUndecidedAndClearsItsStateOnReset) {
  NeuralEstimator estimator(network());
  EXPECT_EQ(estimator.belief().p_any_wheel, 0.5);
  EXPECT_FALSE(estimator.belief().wheel[0].contact);
  const auto stream = moving_robot(33);
  std::vector<double> first;
  for (const Signals& s : stream) first.push_back(estimator.update(s).p_any_wheel);
  estimator.reset();
  EXPECT_EQ(estimator.belief().p_any_wheel, 0.5);
  for (std::size_t k = 0; k < stream.size(); ++k) {
    ASSERT_EQ(estimator.update(stream[k]).p_any_wheel, first[k]);
  }
}

TEST(NeuralEstimator, RelaxesThroughBadSignalsAndRecovers) {
  NeuralEstimator estimator(network());
  auto stream = moving_robot(2000);
  for (std::size_t k = 500; k < 1500; ++k) {
    switch (k % 4) {
      case 0:
        stream[k].leg[1].wheel.velocity = std::nan("");
        break;
      case 1:
        stream[k].angular_velocity.x() = HUGE_VAL;
        break;
      case 2:
        stream[k].vertical_acceleration = std::nan("");
        break;
      default:
        stream[k].ground_velocity_command = -HUGE_VAL;
        break;
    }
  }
  for (std::size_t k = 0; k < stream.size(); ++k) {
    const Belief& belief = estimator.update(stream[k]);
    ASSERT_TRUE(belief.p_any_wheel >= 0.0 && belief.p_any_wheel <= 1.0) << k;
    const bool bad = k >= 500 && k < 1500;
    ASSERT_EQ(belief.status, bad ? SignalStatus::invalid : SignalStatus::good) << k;
    if (k == 1499) {
      ASSERT_NEAR(belief.p_any_wheel, 0.5, 1e-3);
    }
  }
  EXPECT_GT(std::abs(estimator.belief().p_any_wheel - 0.5), 1e-3);
}

TEST(NeuralEstimator, IgnoresTorques) {
  NeuralEstimator clean(network());
  NeuralEstimator without_torques(network());
  for (Signals s : moving_robot(50)) {
    const double expected = clean.update(s).p_any_wheel;
    for (LegSignals& leg : s.leg) leg.knee.torque = leg.wheel.torque = std::nan("");
    EXPECT_EQ(without_torques.update(s).p_any_wheel, expected);
  }
}

TEST(NeuralEstimator, StartsAnewAfterAGap) {
  const auto net = network();
  NeuralEstimator estimator(net);
  auto stream = moving_robot(43);
  for (std::size_t k = 0; k < 42; ++k) estimator.update(stream[k]);
  stream[42].time += 10.0;
  EXPECT_EQ(estimator.update(stream[42]).status, SignalStatus::gap);
  NeuralForward fresh(net);
  EXPECT_NEAR(estimator.belief().p_any_wheel, logistic(fresh.step(neural_input(stream[42]))[0]),
              1e-7);
}

TEST(NeuralEstimator, RefusesInvalidNetworksAndSettings) {
  EXPECT_THAT([] { NeuralEstimator(nullptr); }, ThrowsMessage<InputError>(HasSubstr("network")));
  EXPECT_THAT([] { NeuralEstimator(test::shared({})); },
              ThrowsMessage<InputError>(HasSubstr("gru")));
  EXPECT_THAT(
      [] { NeuralEstimator(network(), {.sample_rate = 300.0, .threshold = 0.8, .guard = {}}); },
      ThrowsMessage<InputError>(HasSubstr("whole number of samples")));
  EXPECT_THAT(
      [] { NeuralEstimator(network(), {.sample_rate = 100.0, .threshold = 0.8, .guard = {}}); },
      ThrowsMessage<InputError>(HasSubstr("whole number of samples")));
  EXPECT_THAT(
      [] { NeuralEstimator(network(), {.sample_rate = 1e3, .threshold = 1.5, .guard = {}}); },
      ThrowsMessage<InputError>(HasSubstr("threshold")));
}

TEST(BatchedNeuralNetwork, EqualsOneEstimatorPerNoiseLevel) {
  const auto net = network();
  const std::vector<experiments::BatchNoise> levels = {
      {}, {.acceleration = 0.23}, {.acceleration = 5.0}, {.acceleration = 10.0}};
  std::vector<NeuralEstimator> estimators(levels.size(), NeuralEstimator(net));
  test::Normal normal(9);
  for (const bool again : {false, true}) {
    experiments::BatchedNeuralNetwork batch(net, {}, levels);
    for (auto& estimator : estimators) {
      if (again) estimator.reset();
    }
    for (const Signals& clean : moving_robot(300)) {
      const Eigen::Vector3d draw(normal(), normal(), normal());
      batch.update(clean, draw);
      for (std::size_t i = 0; i < levels.size(); ++i) {
        Signals noisy = clean;
        noisy.linear_acceleration += levels[i].acceleration * draw;
        ASSERT_NEAR(batch.p_contact()[i], estimators[i].update(noisy).p_any_wheel, 1e-5);
      }
    }
  }
}

TEST(BatchedNeuralNetwork, SkipsSignalsThatAreNotFiniteAndRefusesInvalidLevels) {
  const auto net = network();
  const auto batch_with = [&](const std::vector<experiments::BatchNoise>& levels) {
    return experiments::BatchedNeuralNetwork(net, {}, levels);
  };
  experiments::BatchedNeuralNetwork batch = batch_with({{.acceleration = 1.0}});
  const auto stream = moving_robot(20);
  for (const Signals& s : stream) batch.update(s, Eigen::Vector3d::Zero());
  const double before = batch.p_contact()[0];
  Signals bad = stream[0];
  bad.angular_velocity.y() = std::nan("");
  for (int k = 0; k < 20; ++k) batch.update(bad, Eigen::Vector3d::Zero());
  EXPECT_EQ(batch.p_contact()[0], before);
  EXPECT_THROW(batch_with({}), InputError);
  EXPECT_THROW(batch_with({{.acceleration = -1.0}}), InputError);
  EXPECT_THROW(batch_with({{.acceleration = std::nan("")}}), InputError);
}

}  // namespace
}  // namespace touchdown
