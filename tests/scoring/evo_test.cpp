#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "scoring/trajectory.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::scoring {
namespace {

/// What `evo` says of an estimate: absolute trajectory error with all of it laid on the truth, and
/// relative pose error over a metre of the true way.
constexpr const char* script = R"(import sys
from evo.core import metrics
from evo.tools import file_interface
truth, told = (file_interface.read_tum_trajectory_file(path) for path in sys.argv[1:3])
rpe = metrics.RPE(metrics.PoseRelation.translation_part, 1.0, metrics.Unit.meters,
                  all_pairs=False, pairs_from_reference=True)
rpe.process_data((truth, told))
told.align(truth)
ape = metrics.APE(metrics.PoseRelation.translation_part)
ape.process_data((truth, told))
print(*("%.12f" % one.get_statistic(metrics.StatisticsType.rmse) for one in (ape, rpe)))
)";

/// A winding way over hills, and the same as somebody sees it who errs in scale, heading and place.
Trajectory winding(double scale, double drift) {
  Trajectory way;
  for (int k = 0; k < 2000; ++k) {
    const double t = 0.01 * k;
    const double yaw = 0.4 * std::sin(0.7 * t) + drift * t;
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
    const Eigen::Vector3d place(scale * 0.6 * t, std::sin(0.5 * t) + drift * t * t,
                                0.2 * std::sin(t));
    way.push_back({t, place, turn, Eigen::Vector3d::Zero()});
  }
  return way;
}

TEST(Evo, AgreesAboutAbsoluteAndRelativeErrors) {
  if (std::system("python3 -c 'import evo' 2> /dev/null") != 0) {
    GTEST_SKIP() << "evo is not installed (no Debian package; `pip install evo`)";
  }
  const Trajectory truth = winding(1.0, 0.0);
  const Trajectory told = winding(1.02, 0.01);
  const ScratchFolder folder;
  const std::string command =
      fmt::format("python3 {} {} {}", folder.write("errors.py", script).string(),
                  folder.write("truth.tum", to_tum(truth)).string(),
                  folder.write("told.tum", to_tum(told)).string());
  const std::unique_ptr<FILE, int (*)(FILE*)> evo(::popen(command.c_str(), "r"), ::pclose);
  std::array<double, 2> said = {};
  ASSERT_EQ(std::fscanf(evo.get(), "%lf %lf", said.data(), &said[1]), 2) << command;
  const TrajectoryScore score = score_trajectory(told, truth);
  EXPECT_NEAR(score.ate(), said[0], 1e-6);
  EXPECT_NEAR(score.rpe(), said[1], 1e-6);
}

}  // namespace
}  // namespace touchdown::scoring
