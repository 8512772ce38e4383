#include "render/operating_points/front_figure.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::render {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(OperatingPointsFigure, HasTheFrontOfEveryEstimatorAndARingForItsOwnThresholds) {
  const ScratchFolder folder;
  const Table table = from_csv(
      "torque_noise_nm,accelerometer_noise_mps2,estimator,leave_below,return_above,"
      "balanced_accuracy,extra_switches_per_minute,on_front\n"
      "0,0,robust,,,0.97,12,0\n"
      "0,0,robust,0.5,0.9,0.98,7,1\n"
      "0,0,robust,0.4,0.9,0.96,9,0\n"
      "0,0,robust,0.1,0.9,0.95,0,1\n"
      "0,0,phase,,,0.99,2,0\n"
      "0,0,phase,0.5,0.9,0.992,3,1\n"
      "1,5,robust,,,0.75,40,0\n"
      "1,5,robust,0.5,0.9,0.75,41,1\n");
  draw_operating_points_figure(table, {"robust", "phase"}, "contact: normal force > 1 N",
                               folder / "figure");
  for (const char* kind : {"figure.png", "figure.svg", "figure.pdf"}) {
    EXPECT_TRUE(std::filesystem::exists(folder / kind)) << kind;
  }
  const std::string script = read_file(folder / "figure.gp");
  EXPECT_THAT(script,
              AllOf(HasSubstr("Bayes filter (robust)"), HasSubstr("Phase filter"),
                    HasSubstr("0 N·m, 0 m/s²"), HasSubstr("1 N·m, 5 m/s²"),
                    HasSubstr("normal force > 1 N"), HasSubstr("own decision 3.00 % with 12.0")));
  const std::string data = read_file(folder / "figure.dat");
  EXPECT_THAT(data, AllOf(HasSubstr("0.3\t5\n7\t2\n"), HasSubstr("\n\n40\t25\n")));
  EXPECT_THAT(data, Not(HasSubstr("9\t4\n")));  // others do better in both
}

}  // namespace
}  // namespace touchdown::render
