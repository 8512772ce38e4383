#include "experiments/batch/phase.hpp"

#include <limits>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "estimator/phase/filter.hpp"
#include "tests/estimator/phase/synthetic.hpp"
#include "tests/experiments/batch/noise.hpp"

namespace touchdown::experiments {
namespace {

/// A grid, and levels with torque noise on knees or wheels only.
std::vector<BatchNoise> phase_levels() {
  std::vector<BatchNoise> levels;
  for (const double torque : {0.0, 0.5, 3.0}) {
    for (const double acceleration : {0.0, 1.0, 9.0}) {
      levels.push_back({torque, torque, acceleration});
    }
  }
  levels.push_back({2.0, 0.0, 1.0});
  levels.push_back({0.0, 2.0, 0.5});
  return levels;
}

PhaseFilterConfig small_config() {
  PhaseFilterConfig config;
  config.fit = test::small_phase_fit();
  config.guard.frozen_after = 0.0;
  return config;
}

void expect_equal_to_scalar_filters(const PhaseFilterConfig& config) {
  const auto model = std::make_shared<const PhaseModel>(test::small_phase_model());
  const std::vector<BatchNoise> grid = phase_levels();
  BatchedPhaseFilter batch(model, config, grid);
  std::vector<PhaseFilter> filters(grid.size(), PhaseFilter(model, config));
  test::Normal normal(17);
  std::size_t flights = 0;
  for (const Signals& clean : test::phase_run(6, 31, 4).signals) {
    const NoiseStep draws = draw(normal);
    batch.update(clean, draws);
    for (std::size_t level = 0; level < grid.size(); ++level) {
      const Belief& belief = filters[level].update(noisy(clean, draws, grid[level]));
      for (std::size_t side = 0; side < 2; ++side) {
        ASSERT_EQ(belief.wheel[side].p_contact, batch.p_contact(static_cast<Side>(side))[level])
            << level << " at " << clean.time;
        ASSERT_EQ(belief.wheel[side].contact, batch.contact(static_cast<Side>(side))[level] > 0.5);
        flights += belief.wheel[side].contact ? 0U : 1U;
      }
    }
  }
  EXPECT_GT(flights, 1000U);
}

TEST(BatchedPhaseFilter, EqualsTheScalarFilterAtEveryLevel) {
  expect_equal_to_scalar_filters(small_config());
}

TEST(BatchedPhaseFilter, EqualsTheScalarFilterWithGivenNoise) {
  PhaseFilterConfig config = small_config();
  config.noise = PhaseNoise{0.5, 0.2, 1.0};
  expect_equal_to_scalar_filters(config);
}

TEST(BatchedPhaseFilter, RefusesBadLevels) {
  const auto model = std::make_shared<const PhaseModel>(test::small_phase_model());
  const auto with = [&](const std::vector<BatchNoise>& bad) {
    BatchedPhaseFilter(model, small_config(), bad);
  };
  EXPECT_THROW(with({}), InputError);
  EXPECT_THROW(with({{-1.0, 0.0, 0.0}}), InputError);
  EXPECT_THROW(with({{0.0, 0.0, std::numeric_limits<double>::quiet_NaN()}}), InputError);
}

}  // namespace
}  // namespace touchdown::experiments
