#include "apps/training/rollout.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <gmock/gmock.h>
#include <tbb/global_control.h>

#include "core/error.hpp"
#include "estimator/neural/network.hpp"
#include "scenarios/engine.hpp"

namespace touchdown::training {
namespace {

bool should_continue() { return true; }

RolloutConfig config() {
  RolloutConfig c;
  c.scenarios = {TOUCHDOWN_SOURCE_DIR "/scenarios/lift_drive.yaml"};
  c.steps = 100;
  return c;
}

RolloutScenes scene(const RolloutConfig& c, double duration = 2.0) {
  RolloutScenes scenes = training_scenes(c);
  for (RolloutScenes::Scene& scene : scenes.scenes) scene.scenario.end.duration = duration;
  return scenes;
}

TEST(Rollout, HasContactFlightAndPlausibleNumbers) {
  const RolloutConfig c = config();
  const EpisodeBatch batch = roll_out(c, scene(c), 1, 0, 16, should_continue);
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
  // The robot falls and rises: the vertical velocity is plausible for the forces.
  float fastest = 0.0F;
  for (std::size_t row = 0; row < 1600; ++row) {
    fastest = std::max(fastest, std::abs(batch.velocity[row * 3 + 2]));
  }
  EXPECT_GT(fastest, 0.2F);
  EXPECT_LT(fastest, 10.0F);
}

TEST(Rollout, CutsEpisodesFromRunsWithoutAGap) {
  const RolloutConfig c = config();
  const RolloutScenes scenes = scene(c);
  ASSERT_EQ(episodes_per_run(c, scenes.scenes[0].scenario), 4);
  EXPECT_EQ(runs_for(c, scenes, 9), 3);
  const EpisodeBatch batch = roll_out(c, scenes, 1, 0, 4, should_continue);
  RolloutConfig whole = c;
  whole.steps = 400;
  const EpisodeBatch run = roll_out(whole, scenes, 1, 0, 1, should_continue);
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
  const RolloutScenes scenes = scene(c);
  const auto rolled = [&](std::size_t threads, std::int64_t first, int environments) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return roll_out(c, scenes, 3, first, environments, should_continue);
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

TEST(Rollout, MarksTheBeginningsOfRuns) {
  RolloutConfig c = config();
  c.steps = 200;
  RolloutScenes scenes = scene(c, 1.0);
  scenes.scenes[0].scenario.end.fall_tilt = 0.02;  // every small tilt is a fall
  const EpisodeBatch batch = roll_out(c, scenes, 1, 0, 4, should_continue);
  const auto starts = std::count(batch.keep.begin(), batch.keep.end(), 0.0F);
  EXPECT_GT(starts, 4);
  EXPECT_LT(starts, static_cast<std::ptrdiff_t>(batch.keep.size()));
}

TEST(Rollout, EndsWithoutARobotThatStandsWhenStoppedAndWithoutWholeSteps) {
  RolloutConfig c = config();
  RolloutScenes scenes = scene(c);
  EXPECT_THROW(roll_out(c, scenes, 1, 0, 4, [] { return false; }), Stopped);
  scenes.scenes[0].scenario.end.fall_tilt = 1e-6;
  EXPECT_THROW(roll_out(c, scenes, 1, 0, 1, should_continue), InputError);
  c.control_step_us = 1500;  // no multiple of the physics step
  EXPECT_THROW(training_scenes(c), InputError);
}

TEST(Rollout, UsesScenesInTurnThenTheNextEngine) {
  RolloutConfig c = config();
  c.scenarios.push_back(TOUCHDOWN_SOURCE_DIR "/scenarios/hang.yaml");
  c.simulators = {"bullet", "mujoco"};
  const RolloutScenes scenes = scene(c, 0.5);
  ASSERT_EQ(scenes.scenes.size(), 4U);
  const EpisodeBatch batch = roll_out(c, scenes, 1, 0, 4, should_continue);
  for (std::size_t i = 0; i < 4; ++i) {
    RolloutScenes alone = scenes;
    alone.scenes = {scenes.scenes[i]};
    const EpisodeBatch one =
        roll_out(c, alone, 1, static_cast<std::int64_t>(i), 1, should_continue);
    for (std::size_t step = 0; step < 100; ++step) {
      ASSERT_EQ(batch.contact[step * 4 + i], one.contact[step]) << i;
      ASSERT_EQ(batch.velocity[(step * 4 + i) * 3], one.velocity[step * 3]) << i;
      ASSERT_LE(one.contact[step], i % 2 == 0 ? 1.0F : 0.0F) << "the second scene hangs";
    }
  }
}

TEST(Rollout, FillsEnvironmentsFromRunsOfDifferentLengths) {
  RolloutConfig c = config();
  c.scenarios.push_back(c.scenarios.front());
  RolloutScenes scenes = scene(c, 1.5);
  scenes.scenes[1].scenario.end.duration = 0.5;
  EXPECT_EQ(runs_for(c, scenes, 4), 2);
  EXPECT_EQ(runs_for(c, scenes, 5), 3);
  EXPECT_EQ(runs_for(c, scenes, 8), 4);
  const EpisodeBatch batch = roll_out(c, scenes, 1, 0, 5, should_continue);
  EXPECT_EQ(std::count(batch.keep.begin(), batch.keep.begin() + 5, 0.0F), 3) << "runs begin";
}

TEST(Rollout, AveragesAccelerationsOverTheNetworksStep) {
  RolloutConfig c = config();
  c.control_step_us = 1000;
  c.steps = 40;
  const RolloutScenes scenes = scene(c, 0.2);
  const EpisodeBatch batch = roll_out(c, scenes, 7, 0, 1, should_continue);
  scenarios::Scenario drawn = scenarios::perturbed(scenes.scenes[0].scenario, 7, 0);
  drawn.end.duration = 0.2;
  const logs::Recording run = scenarios::play(drawn, "bullet", 7, 0);
  ASSERT_GE(run.steps(), 200U);
  for (std::size_t step = 1; step < 40; ++step) {
    double mean = 0.0;
    for (std::size_t k = 5 * step - 4; k <= 5 * step; ++k) {
      mean += run.observation[k].imu.linear_acceleration.z() / 5.0;
    }
    const float* input = &batch.input[step * neural_input_count];
    EXPECT_NEAR(input[2], mean, 1e-4 * std::max(1.0, std::abs(mean)));
    EXPECT_NEAR(input[5], run.observation[5 * step].imu.angular_velocity.z(), 1e-5);
  }
}

TEST(Rollout, AppliesSensorsAndTheNoiseShare) {
  RolloutConfig c = config();
  const RolloutScenes ideal = scene(c);
  const EpisodeBatch clean = roll_out(c, ideal, 1, 0, 8, should_continue);
  const auto deviation = [&](const EpisodeBatch& batch, std::size_t first, std::size_t count) {
    double sum = 0.0;
    for (std::size_t step = 0; step < 100; ++step) {
      for (std::size_t i = first; i < first + count; ++i) {
        const std::size_t at = (step * 8 + i) * neural_input_count;
        sum += std::pow(batch.input[at] - clean.input[at], 2);
      }
    }
    return std::sqrt(sum / (100.0 * static_cast<double>(count)));
  };
  c.noise.acceleration = 2.0;
  EXPECT_NEAR(deviation(roll_out(c, ideal, 1, 0, 8, should_continue), 0, 8), 2.0, 0.2);
  c.noise_share = {0.0, 0.0};
  EXPECT_EQ(deviation(roll_out(c, ideal, 1, 0, 8, should_continue), 0, 8), 0.0);
  c.noise_share = {0.0, 1.0};
  const EpisodeBatch shared = roll_out(c, ideal, 1, 0, 8, should_continue);
  EXPECT_GT(std::abs(deviation(shared, 0, 4) - deviation(shared, 4, 4)), 0.05)
      << "the share differs by run";
  c.noise.acceleration = 0.0;
  c.sensors = TOUCHDOWN_SOURCE_DIR "/noise/profiles/upkie.yaml";
  const EpisodeBatch reported = roll_out(c, scene(c), 1, 0, 8, should_continue);
  EXPECT_GT(deviation(reported, 0, 8), 0.01);
  EXPECT_EQ(reported.contact, clean.contact) << "labels are those of the truth";
}

TEST(Rollout, UsesSeparateValidationScenesIfGiven) {
  RolloutConfig c = config();
  EXPECT_EQ(validation_scenes(c).scenes.at(0).scenario.name, "lift_drive");
  c.validation_scenarios = {TOUCHDOWN_SOURCE_DIR "/scenarios/hang.yaml"};
  EXPECT_EQ(validation_scenes(c).scenes.at(0).scenario.name, "hang");
  EXPECT_EQ(training_scenes(c).scenes.at(0).scenario.name, "lift_drive");
}

}  // namespace
}  // namespace touchdown::training
