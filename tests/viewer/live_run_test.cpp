#include "apps/viewer/live_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "logs/log/recording_file.hpp"
#include "scenarios/engine.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::viewer {
namespace {

LiveScene standing(const std::string& engine) {
  LiveScene scene;
  scene.scenario.name = "standing";
  scene.scenario.robot = TOUCHDOWN_SOURCE_DIR "/models/upkie.xml";
  scene.engine = engine;
  return scene;
}

std::vector<experiments::LogEstimator> some_estimators() {
  std::vector<experiments::LogEstimator> estimators;
  for (const char* const name : {"load_filter", "upkie_observer", "free_fall"}) {
    estimators.push_back(experiments::log_estimator({.name = name}));
  }
  return estimators;
}

std::string bytes_of(const logs::Recording& recording, const ScratchFolder& folder) {
  logs::write_recording(recording, folder / "some.mpack");
  return read_file(folder / "some.mpack");
}

class LiveRunTest : public ::testing::TestWithParam<std::string> {
 protected:
  std::vector<experiments::LogEstimator> estimators_ = some_estimators();
};

/// Does everything that a user can do.
void use(LiveRun& run, std::uint64_t step) {
  LiveSettings settings = run.settings();
  switch (step) {
    case 100:
      run.drive(0.5, 0.0);
      break;
    case 400:
      run.drive(0.0, 0.4);
      settings.noise = {.knee_torque = 1.0, .wheel_torque = 1.0, .acceleration = 5.0};
      run.change(settings);
      break;
    case 600:
      settings.contact_source = 2;  // the load filter
      settings.contact_delay = 0.03;
      run.change(settings);
      break;
    case 700:
      run.drag(
          Drag{run.simulator().ground_truth().base_position + Eigen::Vector3d(0.1, 0.05, 0.3)});
      break;
    case 1200:
      run.drag(std::nullopt);
      break;
    case 1500:
      settings.contact_source = 1;  // the truth
      settings.sensors = noise::find_sensor_profile("noise/profiles/upkie.yaml");
      run.change(settings);
      run.hop();
      break;
    case 2600:
      run.crouch(0.7);
      break;
    default:
      break;
  }
}

TEST_P(LiveRunTest, RepeatsThroughTheEngineToTheByte) {
  const ScratchFolder folder;
  LiveRun run(standing(GetParam()), estimators_, {}, true);
  for (std::uint64_t step = 0; step < 3000; ++step) {
    use(run, step);
    run.step();
  }
  const logs::Recording driven = run.recording();
  ASSERT_GT(driven.steps(), 1000u);
  const scenarios::Scenario scenario =
      scenarios::scenario_from_yaml(YamlDocument::parse(driven.info.scenario_yaml, "driven"));
  EXPECT_GT(scenario.forces.size(), 40u);
  EXPECT_GT(scenario.policy.contact_script.size(), 1u);
  const logs::Recording again =
      scenarios::play(scenario, GetParam(), driven.info.seed, driven.info.run);
  EXPECT_EQ(bytes_of(driven, folder), bytes_of(again, folder));
}

TEST_P(LiveRunTest, DoesNotDependOnItsEstimators) {
  // With the truth as contact source, estimators only watch.
  LiveSettings settings;
  settings.contact_source = 1;
  const std::vector<experiments::LogEstimator> none;
  LiveRun alone(standing(GetParam()), none, settings, true);
  LiveRun watched(standing(GetParam()), estimators_, settings, true);
  for (int step = 0; step < 500; ++step) {
    alone.step();
    watched.step();
  }
  EXPECT_EQ(alone.recording().truth.back().base_position,
            watched.recording().truth.back().base_position);
}

TEST_P(LiveRunTest, ADragLiftsTheRobotAndEstimatorsSeeIt) {
  LiveRun run(standing(GetParam()), estimators_, {}, false);
  for (int step = 0; step < 500; ++step) run.step();
  EXPECT_EQ(run.true_contact(), (std::array<bool, 2>{true, true}));
  run.drag(Drag{run.simulator().ground_truth().base_position + Eigen::Vector3d(0.0, 0.0, 0.5)});
  for (int step = 0; step < 1000; ++step) run.step();
  EXPECT_EQ(run.true_contact(), (std::array<bool, 2>{false, false}));
  for (const std::size_t estimator : {0u, 1u}) {
    EXPECT_FALSE(run.estimators()[estimator].belief.wheel[0].contact) << estimator;
  }
  EXPECT_GT(run.estimators()[0].accuracy(), 0.9);
  EXPECT_NEAR(run.drag_force().z(), 9.81 * run.simulator().model().mj->body_subtreemass[0], 5.0);
}

TEST_P(LiveRunTest, OffersTheScenariosContactSourceTheTruthAndEveryEstimator) {
  LiveScene scene = standing(GetParam());
  const LiveRun run(scene, estimators_, {}, false);
  EXPECT_EQ(run.contact_sources().size(), 5u);
  EXPECT_EQ(run.contact_sources()[0], "upkie_observer");
  EXPECT_EQ(run.contact_sources()[1], "truth");
  scene.scenario.policy.contact = "truth";
  const LiveRun with_truth(scene, estimators_, {}, false);
  EXPECT_EQ(with_truth.contact_sources().size(), 4u);
}

TEST_P(LiveRunTest, SamplesEveryFourthStepOnce) {
  LiveRun run(standing(GetParam()), estimators_, {}, false);
  for (int step = 0; step < 10; ++step) run.step();
  EXPECT_EQ(run.take_samples().size(), 3u);  // steps 0, 4, 8
  EXPECT_TRUE(run.take_samples().empty());
  for (int step = 0; step < 3; ++step) run.step();
  ASSERT_EQ(run.take_samples().size(), 1u);  // step 12
}

INSTANTIATE_TEST_SUITE_P(Engines, LiveRunTest, ::testing::Values("mujoco", "bullet"),
                         [](const auto& engine) { return engine.param; });

TEST(RealTimeLoop, SimulatesSingleStepsWhilePaused) {
  const std::vector<experiments::LogEstimator> none;
  RealTimeLoop loop(std::make_unique<LiveRun>(standing("mujoco"), none, LiveSettings{}, false));
  loop.set_paused(true);
  const std::uint64_t before = loop.state().steps;
  loop.step(3);
  while (loop.state().steps < before + 3) std::this_thread::yield();
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_EQ(loop.state().steps, before + 3);
  loop.set_paused(false);
  while (loop.state().steps < before + 10) std::this_thread::yield();
}

TEST(RealTimeLoop, ReplacesARunAndReturnsTheOldOne) {
  const std::vector<experiments::LogEstimator> none;
  RealTimeLoop loop(std::make_unique<LiveRun>(standing("mujoco"), none, LiveSettings{}, false));
  while (loop.state().steps < 5) std::this_thread::yield();
  const auto old =
      loop.replace(std::make_unique<LiveRun>(standing("bullet"), none, LiveSettings{}, false));
  EXPECT_EQ(old->scene().engine, "mujoco");
  loop.use([](const LiveRun& run) { EXPECT_EQ(run.scene().engine, "bullet"); });
}

TEST(RealTimeLoop, EndsWithARobotThatFell) {
  const std::vector<experiments::LogEstimator> none;
  LiveScene scene = standing("mujoco");
  scene.scenario.forces = {{.time = 0.0, .duration = 0.5, .force = {0.0, 60.0, 0.0}}};
  RealTimeLoop loop(std::make_unique<LiveRun>(scene, none, LiveSettings{}, false));
  while (!loop.state().outcome) std::this_thread::yield();
  EXPECT_EQ(loop.state().outcome, logs::Outcome::fell);
  const std::uint64_t steps = loop.state().steps;
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_EQ(loop.state().steps, steps);
}

}  // namespace
}  // namespace touchdown::viewer
