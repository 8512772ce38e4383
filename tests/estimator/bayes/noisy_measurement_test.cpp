#include "estimator/bayes/noisy_measurement.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "estimator/bayes/measurement_fit.hpp"
#include "estimator/numerics/kernel_density.hpp"
#include "tests/estimator/random.hpp"

namespace touchdown {
namespace {

using test::Normal;

constexpr double sample_rate = 1000.0;

/// The noise that a low-pass of 25 ms leaves at 1 kHz: g = 1/25, √(g/(2 − g)).
const double low_pass_share = std::sqrt((1.0 / 25.0) / (2.0 - 1.0 / 25.0));

std::vector<TorqueSample> cloud(std::size_t count, const TorqueSample& centre, double deviation,
                                bool is_absolute, std::uint32_t seed) {
  Normal normal(seed);
  std::vector<TorqueSample> samples(count);
  for (TorqueSample& sample : samples) {
    sample = {centre.knee + deviation * normal(), centre.wheel + deviation * normal()};
    if (is_absolute) sample = {std::abs(sample.knee), std::abs(sample.wheel)};
  }
  return samples;
}

MeasurementConfig following() { return BayesFilterConfig::robust().measurement; }

/// The level of white noise with these standard deviations at knees and wheels (N·m).
std::size_t level_of(const MeasurementConfig& config, const TorqueSample& sigma,
                     double offset = 0.3) {
  TorqueNoise noise(config, sample_rate);
  Normal normal(5);
  std::size_t level = 0;
  for (int i = 0; i < 3000; ++i) {
    const std::array<double, 2> knee = {offset + sigma.knee * normal(),
                                        -offset + sigma.knee * normal()};
    const std::array<double, 2> wheel = {sigma.wheel * normal(), sigma.wheel * normal()};
    level = noise.update(knee, wheel);
  }
  return level;
}

/// The density at a torque of samples that differ from the fitted ones by noise: kernels as wide
/// as the fitted ones and the noise together; the noise of absolute values is folded at zero.
double density_under_noise(const std::vector<TorqueSample>& samples, const TorqueBandwidth& h,
                           const TorqueSample& noise, bool folds, const TorqueSample& at) {
  const auto kernel = [folds](double x, double centre, double width) {
    const auto normal = [width](double d) { return std::exp(-0.5 * d * d / (width * width)); };
    return (normal(x - centre) + (folds ? normal(x + centre) : 0.0)) / width;
  };
  double sum = 0.0;
  for (const TorqueSample& sample : samples) {
    sum += kernel(at.knee, sample.knee, std::hypot(h.knee, noise.knee)) *
           kernel(at.wheel, sample.wheel, std::hypot(h.wheel, noise.wheel));
  }
  return sum / static_cast<double>(samples.size());
}

TEST(NoisyMeasurement, HasTheDensitiesOfNoisySamples) {
  for (const TorqueSign sign : {TorqueSign::absolute, TorqueSign::mirrored}) {
    const bool is_absolute = sign == TorqueSign::absolute;
    MeasurementConfig config = following();
    config.torque.sign = sign;
    config.noise.share = 1.0;
    config.fit.bandwidth = TorqueBandwidth{0.04, 0.02};
    config.fit.knee_range = {is_absolute ? 0.0 : -3.0, 3.0};
    config.fit.wheel_range = {is_absolute ? 0.0 : -1.5, 1.5};
    const auto contact = cloud(300, {1.2, 0.3}, 0.2, is_absolute, 1);
    const auto air = cloud(300, {0.3, 0.2}, 0.05, is_absolute, 2);
    const NoisyMeasurement model(fit_measurement_model(contact, air, config.fit), config);
    // What the low-pass leaves of noise at knee and wheel: none, one of them, both.
    for (const TorqueSample& left :
         {TorqueSample{0.0, 0.0}, TorqueSample{0.1, 0.0}, TorqueSample{0.0, 0.05},
          TorqueSample{0.05, 0.1}, TorqueSample{0.1, 0.1}}) {
      const std::size_t level =
          level_of(config, {left.knee / low_pass_share, left.wheel / low_pass_share});
      for (double knee = 0.2; knee < 1.3; knee += 0.1) {
        const TorqueSample at = {knee, 0.25};
        const auto& h = *config.fit.bandwidth;
        const Likelihoods expected = {density_under_noise(contact, h, left, is_absolute, at),
                                      density_under_noise(air, h, left, is_absolute, at)};
        EXPECT_NEAR(measurement_probability(model.at(level)(at)), measurement_probability(expected),
                    0.03)
            << "noise " << left.knee << ' ' << left.wheel << " at " << knee;
      }
    }
  }
}

TEST(NoisyMeasurement, StaysAsFittedUnlessItFollowsTheNoise) {
  MeasurementConfig config = following();
  config.noise.is_followed = false;
  const MeasurementModel fitted = fit_measurement_model(
      cloud(300, {1.2, 0.3}, 0.2, true, 1), cloud(300, {0.1, 0.1}, 0.05, true, 2), config.fit);
  const NoisyMeasurement model(fitted, config);
  for (const double sigma : {0.0, 0.1, 1.0, 4.0}) {
    const std::size_t level = level_of(config, {sigma, sigma});
    EXPECT_EQ(level, 0U) << sigma;
    EXPECT_EQ(model.at(level)({0.4, 0.2}).contact, fitted({0.4, 0.2}).contact) << sigma;
  }
}

TEST(TorqueNoise, SeparatesKneesFromWheels) {
  const MeasurementConfig config = following();
  const std::size_t none = level_of(config, {0.0, 0.0});
  EXPECT_EQ(none, 0U);
  EXPECT_EQ(level_of(config, {0.02, 0.011}), 0U) << "the noise of Upkie's sensors";
  std::vector<std::size_t> levels;
  for (const TorqueSample& sigma :
       {TorqueSample{1.0, 0.0}, TorqueSample{0.0, 1.0}, TorqueSample{1.0, 1.0}}) {
    const std::size_t level = level_of(config, sigma);
    EXPECT_EQ(std::count(levels.begin(), levels.end(), level), 0);
    EXPECT_NE(level, none);
    levels.push_back(level);
  }
}

TEST(TorqueNoise, IgnoresSlowTorquesAndLegsWithoutTorques) {
  const MeasurementConfig config = following();
  EXPECT_EQ(level_of(config, {0.0, 0.0}, 8.0), 0U);
  TorqueNoise one_leg(config, sample_rate);
  TorqueNoise swinging(config, sample_rate);
  Normal normal(7);
  Signals signals;
  signals.leg[1].knee.torque = std::numeric_limits<double>::quiet_NaN();
  for (int i = 0; i < 3000; ++i) {
    signals.leg[0].knee.torque = 1.0 + normal();
    signals.leg[0].wheel.torque = 0.2 + normal();
    (void)one_leg.update(signals, {});
    const double torque = 3.0 * std::sin(2.0 * 3.14159 * 4.0 * i / sample_rate);  // 4 Hz
    (void)swinging.update(std::array{torque, -torque}, std::array{torque, torque});
  }
  EXPECT_EQ(one_leg.level(), level_of(config, {1.0, 1.0}));
  EXPECT_EQ(swinging.level(), 0U);
}

TEST(TorqueNoise, KeepsItsEstimateOverAGapAndForgetsItAtAReset) {
  const MeasurementConfig config = following();
  TorqueNoise noise(config, sample_rate);
  Normal normal(3);
  for (int i = 0; i < 2000; ++i)
    (void)noise.update(std::array{normal(), normal()}, std::array{normal(), normal()});
  const std::size_t level = noise.level();
  noise.reset_signals();
  EXPECT_EQ(noise.level(), level);
  noise.reset();
  EXPECT_EQ(noise.level(), 0U);
}

}  // namespace
}  // namespace touchdown
