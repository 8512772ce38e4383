#include <gtest/gtest.h>

#include "core/resources.hpp"
#include "render/film/scene_view.hpp"

namespace touchdown::render {
namespace {

models::RobotModel upkie_on(const models::Terrain& terrain) {
  return models::compile_robot_model(find_program_file("models/upkie.xml"), terrain);
}

/// A robot's log: it rolls ahead while it crouches.
logs::Recording robot_log() {
  logs::Recording log;
  for (int k = 0; k < 100; ++k) {
    models::Observation& now = log.observation.emplace_back();
    now.time = 0.001 * k;
    now.servo[models::index(models::Servo::left_wheel)].position = 0.1 * k;
    now.servo[models::index(models::Servo::right_wheel)].position = -0.1 * k;
    now.servo[models::index(models::Servo::left_hip)].position = 0.005 * k;
    now.servo[models::index(models::Servo::right_hip)].position = -0.005 * k;
    now.servo[models::index(models::Servo::left_knee)].position = -0.01 * k;
    now.servo[models::index(models::Servo::right_knee)].position = 0.01 * k;
  }
  return log;
}

TEST(PosesOfARobotsLog, StandOnTheFloorWithTheBaseAboveIt) {
  const models::RobotModel robot = upkie_on({});
  const logs::Recording log = robot_log();
  const Poses poses(robot, log);
  const models::MjDataPtr data(mj_makeData(robot.mj.get()));
  for (const std::size_t row : {0U, 50U, 99U}) {
    poses.apply(row, *data);
    EXPECT_NEAR(data->geom_xpos[3 * robot.tyre_geom[0] + 2], robot.wheel_radius, 1e-9);
    const double base = data->xpos[3 * robot.base_body + 2];
    EXPECT_NEAR(poses.base_position(row).z(), base, 1e-9) << "which the camera follows";
    EXPECT_GT(base, 0.3);
  }
  EXPECT_GT(poses.base_position(0).z(), poses.base_position(99).z() + 0.02) << "it crouches";
}

/// The height of the camera itself.
double height(const SceneCamera& camera, const Eigen::Vector3d& target, double elevation) {
  return target.z() + camera.look_at.z() -
         camera.distance * std::sin(elevation * 3.14159265358979 / 180.0);
}

TEST(TheCamera, IsNeverBelowTheGround) {
  const models::RobotModel robot = upkie_on({});
  const models::MjDataPtr data = models::at_reference(robot);
  update_geoms(*robot.mj, *data);
  const Eigen::Vector3d target(0.0, 0.0, 0.55);
  for (const double distance : {0.4, 2.3, 20.0}) {
    for (double wanted = -89.0; wanted <= 89.0; wanted += 8.9) {
      const SceneCamera camera{.elevation = wanted, .distance = distance};
      const double elevation = elevation_above_ground(robot, *data, camera, target);
      EXPECT_GT(height(camera, target, elevation), 0.09) << wanted << " " << distance;
      EXPECT_LE(elevation, wanted);
      if (height(camera, target, wanted) > 0.11) {
        EXPECT_EQ(elevation, wanted) << distance;
      }
    }
  }
}

}  // namespace
}  // namespace touchdown::render
