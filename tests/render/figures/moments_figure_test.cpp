#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "render/studies/registry.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::render {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

Table moments() {
  return table_of(
      from_csv("simulator,joint,contact,mean_nm,sd_nm,robot_mean_nm,robot_sd_nm\n"
               "mujoco,knee,1,0.34,0.25,0.358,0.229\nmujoco,wheel,1,0.11,0.06,0.109,0.062\n"
               "mujoco,knee,0,0.09,0.06,0.083,0.067\nmujoco,wheel,0,nan,nan,0.012,0.010\n"
               "bullet,knee,1,0.33,0.24,0.358,0.229\nbullet,wheel,1,0.12,0.07,0.109,0.062\n"
               "bullet,knee,0,0.08,0.05,0.083,0.067\nbullet,wheel,0,0.011,0.009,0.012,0.010\n"));
}

Table moment_densities() {
  TextTable table{{"simulator", "joint", "contact", "torque_nm", "density_per_nm"}, {}};
  for (const char* engine : {"mujoco", "bullet"}) {
    for (const char* joint : {"knee", "wheel"}) {
      for (const char* contact : {"0", "1"}) {
        if (engine == std::string("mujoco") && joint == std::string("wheel") && *contact == '0') {
          continue;
        }
        table.rows.push_back({engine, joint, contact, "0.000000", "60.000000"});
        table.rows.push_back({engine, joint, contact, "0.010000", "70.000000"});
      }
    }
  }
  return table_of(table);
}

TEST(MomentsFigure, ShowsEveryEngineBesideTheRealRobot) {
  const ScratchFolder folder;
  const Figure figure = draw_moments_figure(moments(), moment_densities(), folder / "moments");
  EXPECT_TRUE(std::filesystem::exists(figure.png));
  EXPECT_THAT(
      figure_text(read_file(folder / "moments.gp")).alt,
      AllOf(HasSubstr("knee, in contact: MuJoCo 0.340 ± 0.250, Bullet 0.330 ± 0.240, the real "
                      "robot 0.358 ± 0.229."),
            HasSubstr("wheel, in the air: MuJoCo nan ± nan, Bullet 0.011 ± 0.009")));
}

TEST(MomentsFigure, DrawsNoCurveForAnEngineWithoutSamples) {
  const ScratchFolder folder;
  (void)draw_moments_figure(moments(), moment_densities(), folder / "moments");
  // The last panel: MuJoCo's curve, Bullet's, then three rows of moments.
  EXPECT_THAT(read_file(folder / "moments.dat"),
              HasSubstr("NaN\tNaN\n\n\n0.000000\t60.000000\n0.010000\t70.000000\n\n\n"
                        "NaN\tNaN\t3\n0.011\t0.009\t2\n0.012\t0.01\t1\n"));
}

}  // namespace
}  // namespace touchdown::render
