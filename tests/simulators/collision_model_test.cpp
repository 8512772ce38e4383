#include "simulators/collision_model.hpp"

#include "simulators/mujoco_simulator.hpp"
#include "tests/simulators/standing.hpp"

namespace touchdown::simulators {
namespace {

const models::Terrain stairs = {.pieces = {models::Flat{3.0}, models::StairFlight{}}};

TEST(CollisionModel, KeepsExactlyTheGeomsThatCollide) {
  const auto robot = upkie({}, stairs);
  const mjModel& full = *robot->mj;
  const models::MjModelPtr lean = collision_model(full);
  int expected = 0;
  for (int geom = 0; geom < full.ngeom; ++geom) {
    if (!collides(full, geom)) continue;
    EXPECT_EQ(lean->geom_type[expected], full.geom_type[geom]);
    EXPECT_EQ(lean->geom_bodyid[expected], full.geom_bodyid[geom]);
    EXPECT_EQ(lean->geom_rbound[expected], full.geom_rbound[geom]);
    for (int i = 0; i < 3; ++i) {
      EXPECT_EQ(lean->geom_pos[3 * expected + i], full.geom_pos[3 * geom + i]);
      EXPECT_EQ(lean->geom_size[3 * expected + i], full.geom_size[3 * geom + i]);
    }
    EXPECT_STREQ(mj_id2name(lean.get(), mjOBJ_GEOM, expected), mj_id2name(&full, mjOBJ_GEOM, geom));
    ++expected;
  }
  EXPECT_EQ(lean->ngeom, expected);
  EXPECT_LT(3 * lean->ngeom, full.ngeom);
  int listed = 0;
  for (int body = 0; body < lean->nbody; ++body) {
    for (int i = 0; i < lean->body_geomnum[body]; ++i) {
      EXPECT_EQ(lean->geom_bodyid[lean->body_geomadr[body] + i], body);
      ++listed;
    }
  }
  EXPECT_EQ(listed, expected);
}

TEST(CollisionModel, StepsToTheSameBitsAsTheFullModel) {
  const auto robot = upkie({}, stairs);
  RobotState start = upright();
  start.position.z() += 7 * 0.25 + 0.1;
  start.joint_position = {0.3, -0.6, 0.0, -0.3, 0.6, 0.0};
  start.linear_velocity.x() = 1.5;
  MujocoSimulator simulator(robot, {});
  simulator.reset(start);
  const models::MjDataPtr full(mj_makeData(robot->mj.get()));
  mju_copy(full->qpos, simulator.engine_data().qpos, robot->mj->nq);
  mju_copy(full->qvel, simulator.engine_data().qvel, robot->mj->nv);
  int most_contacts = 0;
  for (int i = 0; i < 2000; ++i) {
    simulator.step(torques());
    mju_copy(full->qfrc_applied, simulator.engine_data().qfrc_applied, robot->mj->nv);
    mj_step(robot->mj.get(), full.get());
    most_contacts = std::max(most_contacts, full->ncon);
    ASSERT_EQ(full->ncon, simulator.engine_data().ncon);
    for (int j = 0; j < robot->mj->nq; ++j) {
      ASSERT_EQ(full->qpos[j], simulator.engine_data().qpos[j]) << "step " << i;
    }
  }
  EXPECT_GT(most_contacts, 2);  // the robot tumbled
}

}  // namespace
}  // namespace touchdown::simulators
