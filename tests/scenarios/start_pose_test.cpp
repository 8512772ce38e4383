#include "scenarios/start_pose.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/resizing.hpp"
#include "tests/complaint.hpp"
#include "tests/scenarios/runs.hpp"

namespace touchdown::scenarios {
namespace {

/// Positions of the tyres and the centre of mass in `state`, by MuJoCo's kinematics.
struct Pose {
  Eigen::Vector3d left, right, centre_of_mass;
};

Pose pose(const models::RobotModel& model, const simulators::RobotState& state) {
  const models::MjDataPtr data(mj_makeData(model.mj.get()));
  for (int i = 0; i < 3; ++i) data->qpos[i] = state.position[i];
  data->qpos[3] = state.orientation.w();
  data->qpos[4] = state.orientation.x();
  data->qpos[5] = state.orientation.y();
  data->qpos[6] = state.orientation.z();
  for (std::size_t i = 0; i < models::servo_count; ++i) {
    data->qpos[model.qpos_address[i]] = state.joint_position[i];
  }
  mj_forward(model.mj.get(), data.get());
  const auto at = [](const mjtNum* x, int row) {
    return Eigen::Vector3d(x[3 * row], x[3 * row + 1], x[3 * row + 2]);
  };
  return {at(data->geom_xpos, model.tyre_geom[0]), at(data->geom_xpos, model.tyre_geom[1]),
          at(data->subtree_com, model.base_body)};
}

TEST(StartPose, StandsOnItsWheelsWithTheCentreOfMassAboveThem) {
  const models::Terrain stairs = {.pieces = {models::Flat{3.0}, models::StairFlight{}}};
  const models::RobotModel model =
      models::compile_robot_model(TOUCHDOWN_SOURCE_DIR "/models/upkie.xml", stairs);
  for (const double hip : {0.0, 0.3, 0.6}) {
    for (const double yaw : {0.0, -0.7, 2.0}) {
      const Start start = {
          .x = 0.2, .y = -0.3, .yaw = yaw, .hip = hip, .knee = 1.7 * hip, .clearance = 0.01};
      const Pose at = pose(model, start_pose(model, stairs, start));
      const Eigen::Vector3d axle = 0.5 * (at.left + at.right);
      EXPECT_NEAR(axle.x(), 0.2, 1e-9);
      EXPECT_NEAR(axle.y(), -0.3, 1e-9);
      EXPECT_NEAR(at.left.z(), 7 * 0.25 + 0.05 + 0.01, 1e-9);
      EXPECT_NEAR(at.right.z(), at.left.z(), 1e-9);
      // The axle points left of the heading.
      EXPECT_NEAR(std::atan2(-(at.left - at.right).x(), (at.left - at.right).y()), yaw, 1e-9);
      EXPECT_NEAR(at.centre_of_mass.x(), axle.x(), 1e-3);
      EXPECT_NEAR(at.centre_of_mass.y(), axle.y(), 1e-3);
    }
  }
}

TEST(StartPose, OfACrouchKeepsTheTorsoUpright) {
  const models::RobotModel model =
      models::compile_robot_model(TOUCHDOWN_SOURCE_DIR "/models/upkie.xml", {});
  const auto lean = [&](double hip, double knee_per_hip) {
    const simulators::RobotState state =
        start_pose(model, {}, {.hip = hip, .knee = knee_per_hip * hip});
    return std::abs(Eigen::AngleAxisd(state.orientation).angle());
  };
  for (const double hip : {-0.05, 0.0, 0.1, 0.2, 0.3, 0.455}) {
    EXPECT_LT(lean(hip, policies::knee_per_hip), 0.026) << hip;
  }
  EXPECT_LT(lean(0.455, policies::knee_per_hip), 0.002);
  // The axle below the hip is not the axle below the centre of mass.
  EXPECT_NEAR(lean(0.455, 2.0), 0.066, 0.002);
}

TEST(StartPose, OfUnequalLegsBendsTheLongerOneToShareOneAxle) {
  const models::RobotModel model =
      models::compile_robot_model(TOUCHDOWN_SOURCE_DIR "/models/upkie_asymmetric.yaml", {});
  for (const double hip : {-0.3, -0.05, 0.0, 0.1, 0.455, 0.6}) {
    const Start start = {.hip = hip, .knee = policies::knee_per_hip * hip};
    const simulators::RobotState state = start_pose(model, {}, start);
    const Pose at = pose(model, state);
    EXPECT_NEAR(at.left.z(), model.wheel_radius, 1e-9) << hip;
    EXPECT_NEAR(at.right.z(), model.wheel_radius, 1e-9) << hip;
    EXPECT_NEAR(at.left.x(), at.right.x(), 1e-9) << hip;
    EXPECT_NEAR(at.centre_of_mass.x(), at.left.x(), 1e-3) << hip;
    // The left leg is the longer one: it bends more, to the side of its knee.
    EXPECT_EQ(state.joint_position[models::index(models::Servo::right_hip)], -start.hip);
    EXPECT_EQ(state.joint_position[models::index(models::Servo::right_knee)], start.knee);
    const double side = start.knee < 0.0 ? -1.0 : 1.0;
    const double knee = -side * state.joint_position[models::index(models::Servo::left_knee)];
    // The law of cosines with the links' lengths, from hip to axle.
    const double squares = 0.168 * 0.168 + 0.175 * 0.175;
    const double product = 2.0 * 0.168 * 0.175;
    const double reach = 0.985 * 0.985 * (squares + product * std::cos(start.knee));
    EXPECT_NEAR(std::cos(knee), (reach / (1.015 * 1.015) - squares) / product, 1e-9) << hip;
    EXPECT_GT(knee, side * start.knee) << hip;
  }
}

TEST(StartPose, RefusesLegsThatCannotShareOneAxle) {
  models::RobotModel model =
      models::compile_robot_model(TOUCHDOWN_SOURCE_DIR "/models/upkie.xml", {});
  models::scale_leg(model, 0, 4.0);
  models::scale_leg(model, 1, 0.2);
  models::recompute(*model.mj);
  EXPECT_THAT(complaint_of([&] { (void)start_pose(model, {}, {}); }),
              ::testing::HasSubstr("upkie: its legs"));
}

}  // namespace
}  // namespace touchdown::scenarios
