#include "simulators/collision_model.hpp"

#include "tests/simulators/upkie.hpp"

namespace touchdown::simulators {
namespace {

TEST(CollisionModel, StepsToTheSameBitsAsTheFullModelWithAThirdOfItsGeoms) {
  const auto robot = upkie({}, {.pieces = {models::Flat{3.0}, models::StairFlight{}}});
  const mjModel& full = *robot->mj;
  const models::MjModelPtr lean = collision_model(full);
  EXPECT_LT(3 * lean->ngeom, full.ngeom);
  const models::MjDataPtr of_full(mj_makeData(&full));
  const models::MjDataPtr of_lean(mj_makeData(lean.get()));
  for (mjData* data : {of_full.get(), of_lean.get()}) {
    models::write_pose(*robot, {0.0, 0.0, upright().position.z() + 7 * 0.25 + 0.1},
                       Eigen::Quaterniond::Identity(), {0.3, -0.6, 0.0, -0.3, 0.6, 0.0},
                       data->qpos);
    data->qvel[0] = 1.5;
  }
  int most_contacts = 0;
  for (int i = 0; i < 2000; ++i) {
    mj_step(&full, of_full.get());
    mj_step(lean.get(), of_lean.get());
    most_contacts = std::max(most_contacts, of_full->ncon);
    ASSERT_EQ(of_full->ncon, of_lean->ncon);
    for (int j = 0; j < full.nq; ++j) {
      ASSERT_EQ(of_full->qpos[j], of_lean->qpos[j]) << "step " << i;
    }
  }
  EXPECT_GT(most_contacts, 2);  // the robot tumbled
}

}  // namespace
}  // namespace touchdown::simulators
