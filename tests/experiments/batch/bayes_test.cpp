#include "experiments/batch/bayes.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "estimator/bayes/measurement_only.hpp"
#include "tests/estimator/named_config.hpp"
#include "tests/estimator/synthetic.hpp"

namespace touchdown::experiments {
namespace {

using test::drops;
using test::labelled;
using test::Normal;

MeasurementModel fitted(const BayesFilterConfig& config) {
  const auto samples = labelled(drops(8000), config.measurement.torque);
  return fit_measurement_model(samples.contact, samples.no_contact, config.measurement.fit);
}

/// A grid of levels and a few single ones.
std::vector<BatchNoise> bayes_levels() {
  std::vector<BatchNoise> levels;
  for (const double torque : {0.0, 0.25, 1.0, 3.0}) {
    for (const double acceleration : {0.0, 1.0, 5.0, 7.0, 10.0}) {
      levels.push_back({torque, torque, acceleration});
    }
  }
  levels.push_back({0.5, 0.0, 3.0});
  levels.push_back({0.0, 0.5, 0.01});
  return levels;
}

/// Unit noise on all signals of a batch.
NoiseStep draw(test::Normal& normal) {
  NoiseStep draws;
  draws.acceleration = normal();
  for (TorqueSample& torque : draws.torque) torque = {normal(), normal()};
  return draws;
}

/// The signals of one batch element, for a scalar estimator.
Signals noisy(Signals s, const NoiseStep& draws, const BatchNoise& level) {
  s.vertical_acceleration += level.acceleration * draws.acceleration;
  for (std::size_t side = 0; side < 2; ++side) {
    s.leg[side].knee.torque += level.knee_torque * draws.torque[side].knee;
    s.leg[side].wheel.torque += level.wheel_torque * draws.torque[side].wheel;
  }
  return s;
}

class NamedBatch : public testing::TestWithParam<const char*> {};

TEST_P(NamedBatch, EqualsTheScalarFilterAtEveryLevel) {
  BayesFilterConfig config = test::named(GetParam());
  config.guard.frozen_after = 0.0;
  const MeasurementModel model = fitted(config);
  const std::vector<BatchNoise> grid = bayes_levels();
  BatchedBayesFilter batch(model, config, grid);
  BatchedMeasurement measurements(model, config, grid);
  std::vector<BayesFilter> filters(grid.size(), BayesFilter(model, config));
  std::vector<MeasurementOnly> ablations(grid.size(), MeasurementOnly(model, config));
  Normal normal(17);
  for (const Signals& clean : drops(20'000, 1000.0, 31)) {
    const NoiseStep draws = draw(normal);
    batch.update(clean, draws);
    measurements.update(clean, draws);
    for (std::size_t level = 0; level < grid.size(); ++level) {
      const Signals s = noisy(clean, draws, grid[level]);
      const Belief& belief = filters[level].update(s);
      const Belief& measured = ablations[level].update(s);
      for (const Side side : {Side::left, Side::right}) {
        const auto i = static_cast<std::size_t>(side);
        ASSERT_EQ(belief.wheel[i].p_contact, batch.p_contact(side)[level])
            << level << " at " << clean.time;
        ASSERT_EQ(measured.wheel[i].p_contact, measurements.p_contact(side)[level]);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Configurations, NamedBatch,
                         testing::Values("paper", "paper_rms", "reference", "robust"));

TEST(BatchedBayesFilter, EqualsTheScalarFilterForAnyWindow) {
  for (const char* name : {"reference", "robust"}) {
    for (const int window : {2, 37, 100, 130, 256}) {
      BayesFilterConfig config = test::named(name);
      config.guard.frozen_after = 0.0;
      config.transition.window = window;
      const MeasurementModel model = fitted(config);
      const std::vector<BatchNoise> grid = bayes_levels();
      BatchedBayesFilter batch(model, config, grid);
      std::vector<BayesFilter> filters(grid.size(), BayesFilter(model, config));
      Normal normal(17);
      for (const Signals& clean : drops(1500, 1000.0, 31)) {
        const NoiseStep draws = draw(normal);
        batch.update(clean, draws);
        for (std::size_t level = 0; level < grid.size(); ++level) {
          const Belief& belief = filters[level].update(noisy(clean, draws, grid[level]));
          ASSERT_EQ(belief.wheel[0].p_contact, batch.p_contact(Side::left)[level])
              << name << " window " << window << " level " << level << " at " << clean.time;
        }
      }
    }
  }
}

TEST(BatchedBayesFilter, RefusesInvalidLevels) {
  const BayesFilterConfig config = BayesFilterConfig::robust();
  const MeasurementModel model = fitted(config);
  const std::vector<BatchNoise> none;
  const std::vector<BatchNoise> negative{{0.1, -0.1, 0.0}};
  const std::vector<BatchNoise> bad{{0.1, 0.1, std::nan("")}};
  EXPECT_THROW(BatchedBayesFilter(model, config, none), InputError);
  EXPECT_THROW(BatchedBayesFilter(model, config, negative), InputError);
  EXPECT_THROW(BatchedBayesFilter(model, config, bad), InputError);
}

}  // namespace
}  // namespace touchdown::experiments
