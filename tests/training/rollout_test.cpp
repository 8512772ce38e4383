#include "training/rollout.hpp"

#include <algorithm>
#include <numeric>

#include <gmock/gmock.h>
#include <tbb/global_control.h>

#include "core/error.hpp"
#include "estimator/neural/network.hpp"

namespace touchdown::training {
namespace {

bool go_on() { return true; }

RolloutConfig config() {
  RolloutConfig c;
  c.scenario = TOUCHDOWN_SOURCE_DIR "/scenarios/lift_drive.yaml";
  c.steps = 100;
  return c;
}

scenarios::Scenario scene(const RolloutConfig& c, double duration = 2.0) {
  scenarios::Scenario scenario = rollout_scenario(c);
  scenario.end.duration = duration;
  return scenario;
}

TEST(Rollout, HasContactAndFlightAndNumbersThatMakeSense) {
  const RolloutConfig c = config();
  const EpisodeBatch batch = roll_out(c, scene(c), 1, 0, 16, go_on);
  ASSERT_EQ(batch.contact.size(), 1600U);
  ASSERT_EQ(batch.input.size(), 1600U * neural_input_count);
  const double contact = std::accumulate(batch.contact.begin(), batch.contact.end(), 0.0) / 1600.0;
  EXPECT_GT(contact, 0.4);
  EXPECT_LT(contact, 0.95);
  EXPECT_TRUE(std::all_of(batch.contact.begin(), batch.contact.end(),
                          [](float x) { return x == 0.0F || x == 1.0F; }));
  EXPECT_TRUE(std::all_of(batch.input.begin(), batch.input.end(),
                          [](float x) { return std::abs(x) < 1e4F; }));
  EXPECT_DOUBLE_EQ(batch.seconds(0.005), 8.0);
  // It falls and rises: the vertical velocity is there, and follows from the forces.
  float fastest = 0.0F;
  for (std::size_t row = 0; row < 1600; ++row) {
    fastest = std::max(fastest, std::abs(batch.velocity[row * 3 + 2]));
  }
  EXPECT_GT(fastest, 0.2F);
  EXPECT_LT(fastest, 10.0F);
}

TEST(Rollout, CutsEpisodesFromRunsWithoutAGap) {
  const RolloutConfig c = config();
  const scenarios::Scenario scenario = scene(c);
  ASSERT_EQ(episodes_per_run(c, scenario), 4);
  EXPECT_EQ(runs_for(c, scenario, 9), 3);
  const EpisodeBatch batch = roll_out(c, scenario, 1, 0, 4, go_on);
  RolloutConfig whole = c;
  whole.steps = 400;
  const EpisodeBatch run = roll_out(whole, scenario, 1, 0, 1, go_on);
  for (std::size_t episode = 0; episode < 4; ++episode) {
    for (std::size_t step = 0; step < 100; ++step) {
      ASSERT_EQ(batch.contact[step * 4 + episode], run.contact[episode * 100 + step]);
      ASSERT_EQ(batch.input[(step * 4 + episode) * neural_input_count + 2],
                run.input[(episode * 100 + step) * neural_input_count + 2]);
    }
  }
}

TEST(Rollout, DependsNeitherOnThreadsNorOnOtherRuns) {
  const RolloutConfig c = config();
  const scenarios::Scenario scenario = scene(c);
  const auto rolled = [&](std::size_t threads, std::int64_t first, int environments) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return roll_out(c, scenario, 3, first, environments, go_on);
  };
  const EpisodeBatch one = rolled(1, 0, 8);
  const EpisodeBatch many = rolled(4, 0, 8);
  EXPECT_EQ(one.input, many.input);
  EXPECT_EQ(one.contact, many.contact);
  EXPECT_EQ(one.velocity, many.velocity);
  const EpisodeBatch second_run = rolled(2, 1, 4);
  for (std::size_t step = 0; step < 100; ++step) {
    ASSERT_EQ(second_run.velocity[step * 4 * 3], many.velocity[(step * 8 + 4) * 3]);
  }
  EXPECT_NE(second_run.input, rolled(2, 0, 4).input);
}

TEST(Rollout, MarksWhereAnotherRunBegins) {
  RolloutConfig c = config();
  c.steps = 200;
  scenarios::Scenario scenario = scene(c, 1.0);
  scenario.end.fall_tilt = 0.02;  // falls all the time
  const EpisodeBatch batch = roll_out(c, scenario, 1, 0, 4, go_on);
  const auto starts = std::count(batch.keep.begin(), batch.keep.end(), 0.0F);
  EXPECT_GT(starts, 4);
  EXPECT_LT(starts, static_cast<std::ptrdiff_t>(batch.keep.size()));
}

TEST(Rollout, GivesUpOnARobotThatCannotStand) {
  const RolloutConfig c = config();
  scenarios::Scenario scenario = scene(c);
  scenario.end.fall_tilt = 1e-6;
  EXPECT_THROW(roll_out(c, scenario, 1, 0, 1, go_on), InputError);
}

TEST(Rollout, StopsWhenAsked) {
  const RolloutConfig c = config();
  EXPECT_THROW(roll_out(c, scene(c), 1, 0, 4, [] { return false; }), Stopped);
}

TEST(Rollout, RefusesAControlStepThatCutsPhysicsSteps) {
  RolloutConfig c = config();
  c.control_step_us = 1500;
  EXPECT_THROW(rollout_scenario(c), InputError);
}

}  // namespace
}  // namespace touchdown::training
