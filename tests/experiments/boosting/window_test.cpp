#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "experiments/boosting/inputs.hpp"
#include "tests/estimator/random.hpp"

namespace touchdown::experiments {
namespace {

Signals step(std::size_t k, double left_knee, double right_knee, double acceleration) {
  Signals signals;
  signals.time = 1e-3 * static_cast<double>(k);
  signals.leg[0].knee.torque = left_knee;
  signals.leg[1].knee.torque = right_knee;
  signals.vertical_acceleration = acceleration;
  return signals;
}

TEST(ChannelWindow, HasTheMeansAndDeviationsOfItsLastValues) {
  const std::vector<double> values = test::normals(400, 3.0, 2.0, 1);
  ChannelWindow window(1000.0);
  for (std::size_t k = 0; k < values.size(); ++k) {
    window.update(values[k]);
    const ChannelWindow::Features features = window.features();
    EXPECT_FLOAT_EQ(features[0], static_cast<float>(values[k]));
    std::size_t at = 1;
    for (const std::size_t length : {2U, 5U, 10U, 20U, 50U, 100U}) {
      double sum = 0.0;
      for (std::size_t i = 0; i < length; ++i) sum += i <= k ? values[k - i] : values[0];
      EXPECT_NEAR(features[at++], sum / static_cast<double>(length), 1e-5);
    }
    for (const std::size_t length : {10U, 100U}) {
      double sum = 0.0;
      double squares = 0.0;
      for (std::size_t i = 0; i < length; ++i) {
        const double value = i <= k ? values[k - i] : values[0];
        sum += value;
        squares += value * value;
      }
      const auto count = static_cast<double>(length);
      const double variance = squares / count - sum * sum / count / count;
      EXPECT_NEAR(features[at++], std::sqrt(std::max(0.0, variance)), 1e-5);
    }
  }
}

TEST(ChannelWindow, KeepsSmallDeviationsOfLargeValues) {
  ChannelWindow window(1000.0);
  for (int k = 0; k < 200; ++k) window.update(1e6 + (k % 2 == 0 ? 1e-3 : -1e-3));
  EXPECT_NEAR(window.features().back(), 1e-3, 1e-8);
}

TEST(SignalWindow, MirrorsTheRightLeg) {
  SignalWindow one(TreeInputsConfig{});
  SignalWindow mirrored(TreeInputsConfig{});
  const std::vector<double> torque = test::normals(150, 0.5, 1.0, 2);
  for (std::size_t k = 0; k < torque.size(); ++k) {
    one.update(step(k, torque[k], 2.0, -torque[k]));
    mirrored.update(step(k, -2.0, -torque[k], -torque[k]));
  }
  EXPECT_EQ(one.features(0), mirrored.features(1));
  EXPECT_EQ(one.features(1), mirrored.features(0));
  EXPECT_NE(one.features(0), one.features(1));
}

TEST(SignalWindow, RepeatsMissingValuesUpToTheMaximumGap) {
  SignalWindow window(TreeInputsConfig{});
  for (std::size_t k = 0; k < 50; ++k) window.update(step(k, 1.5, 1.0, 0.1));
  const WindowFeatures before = window.features(0);
  constexpr double missing = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t k = 50; k < 69; ++k) {
    const TreeInputsStep result = window.update(step(k, missing, 1.0, 0.1));
    EXPECT_TRUE(result.is_valid[0] && result.is_valid[1]);
    EXPECT_EQ(result.status, SignalStatus::invalid);
  }
  EXPECT_EQ(window.features(0), before);
  for (std::size_t k = 69; k < 75; ++k) window.update(step(k, missing, 1.0, 0.1));
  EXPECT_FALSE(window.update(step(75, missing, 1.0, 0.1)).is_valid[0]);
  EXPECT_TRUE(window.update(step(76, 1.5, 1.0, 0.1)).is_valid[0]);
}

TEST(SignalWindow, ResetsAfterALongGap) {
  SignalWindow window(TreeInputsConfig{});
  for (std::size_t k = 0; k < 100; ++k) window.update(step(k, 5.0, 5.0, 3.0));
  window.update(step(5000, 1.0, 1.0, 0.0));
  SignalWindow fresh(TreeInputsConfig{});
  fresh.update(step(5000, 1.0, 1.0, 0.0));
  EXPECT_EQ(window.features(0), fresh.features(0));
}

TEST(SignalWindow, IsNotValidBeforeItsFirstTorques) {
  SignalWindow window(TreeInputsConfig{});
  constexpr double missing = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(window.update(step(0, missing, 1.0, 0.1)).is_valid[0]);
}

}  // namespace
}  // namespace touchdown::experiments
