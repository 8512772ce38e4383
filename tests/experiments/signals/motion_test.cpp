#include <gtest/gtest.h>

#include "core/resources.hpp"
#include "experiments/results/odometry.hpp"
#include "experiments/signals/run_signals.hpp"
#include "scenarios/engine.hpp"
#include "scenarios/scenario_file.hpp"

namespace touchdown::experiments {
namespace {

scenarios::Scenario with_robot(const char* robot) {
  scenarios::Scenario scenario;
  scenario.robot = find_resource(robot);
  return scenario;
}

TEST(WheeledBiped, OfUpkiesModelEqualsThatOfOdometry) {
  const odometry::WheeledBiped found =
      wheeled_biped(scenarios::compile_robot(with_robot("models/upkie.xml")));
  const odometry::WheeledBiped known = odometry::upkie();
  EXPECT_LT((found.imu_in_base - known.imu_in_base).norm(), 1e-12);
  EXPECT_NEAR(found.wheel_radius, known.wheel_radius, 1e-12);
  for (std::size_t side = 0; side < 2; ++side) {
    EXPECT_LT((found.leg[side].hip - known.leg[side].hip).norm(), 1e-9);
    EXPECT_LT((found.leg[side].upper - known.leg[side].upper).norm(), 1e-9);
    EXPECT_LT((found.leg[side].lower - known.leg[side].lower).norm(), 1e-9);
    EXPECT_EQ(found.leg[side].turn, known.leg[side].turn);
  }
}

TEST(WheeledBiped, HasTheWheelPositionsOfTheEnginesKinematics) {
  for (const char* robot :
       {"models/upkie.xml", "models/upkie_asymmetric.yaml", "models/upkie_long_legs.yaml",
        "models/upkie_large_wheels.yaml", "models/knee_and_wheel.yaml", "models/hip_roll.yaml",
        "models/ros_style.yaml"}) {
    const models::RobotModel model = scenarios::compile_robot(with_robot(robot));
    std::array<double, models::servo_count> joints = {0.5, -0.8, 1.0, -0.3, 0.9, 2.0};
    for (std::size_t i = 0; i < joints.size(); ++i) {
      if (!model.has(i)) joints[i] = 0.0;  // as in recordings
    }
    const models::MjDataPtr data(mj_makeData(model.mj.get()));
    models::write_pose(model, Eigen::Vector3d::Zero(), Eigen::Quaterniond::Identity(), joints,
                       data->qpos);
    mj_kinematics(model.mj.get(), data.get());
    const odometry::WheeledBiped biped = wheeled_biped(model);
    for (std::size_t side = 0; side < 2; ++side) {
      const Eigen::Vector3d wheel =
          models::vector_at(data->geom_xpos, model.tyre_geom[side]) - model.imu_position;
      const odometry::WheelMotion motion = odometry::motion_of(
          biped.leg[side], {{joints[3 * side], joints[3 * side + 1], joints[3 * side + 2]}, {}});
      EXPECT_LT((motion.centre - wheel).norm(), 1e-6) << robot;
    }
  }
}

/// Robot and engine.
class Driven : public ::testing::TestWithParam<std::tuple<const char*, const char*>> {};

TEST_P(Driven, OdometryFollowsTheRobot) {
  const auto& [robot, engine] = GetParam();
  scenarios::Scenario scenario = scenarios::complete_scenario(
      YamlDocument::parse(std::string("name: drive\nrobot: ") + robot, "drive"));
  // Flat ground, in a curve.
  scenario.velocity = {{0.5, 0.5, 0.3}};
  scenario.end.duration = 6.0;
  const auto scene = scenarios::compile_scene(scenario);
  const logs::Recording recording =
      scenarios::play(scenario, *scenarios::make_simulator(scenario, engine, scene));
  RunSignals run = signals_of(recording, {}, {}, scoring::SampleUnit::run);
  run.motion = std::make_shared<RunMotion>(motion_of(recording, *scene));
  const std::vector<double> sure(run.steps(), 1.0);
  const scoring::TrajectoryScore score =
      score_odometry(run, noise_run(run, {}), {}, {sure, sure}, {});
  EXPECT_GT(score.distance, 2.0);
  EXPECT_LT(score.rms(), 0.01 * score.distance);
  EXPECT_LT(score.height_rms(), 0.005);
  EXPECT_LT(score.velocity_rms(), 0.02);
}

INSTANTIATE_TEST_SUITE_P(
    Robots, Driven,
    ::testing::Combine(::testing::Values("models/upkie.xml", "models/knee_and_wheel.yaml",
                                         "models/hip_roll.yaml", "models/ros_style.yaml"),
                       ::testing::Values("mujoco", "bullet")));

}  // namespace
}  // namespace touchdown::experiments
