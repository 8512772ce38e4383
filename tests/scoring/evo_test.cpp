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

/// Errors of an estimate by `evo`: absolute trajectory error after aligning the whole trajectory,
/// and relative pose error over a metre of the true path.
constexpr const char* script = R"(import sys
from evo.core import metrics
from evo.tools import file_interface
truth, estimate = (file_interface.read_tum_trajectory_file(path) for path in sys.argv[1:3])
rpe = metrics.RPE(metrics.PoseRelation.translation_part, 1.0, metrics.Unit.meters,
                  all_pairs=False, pairs_from_reference=True)
rpe.process_data((truth, estimate))
estimate.align(truth)
ape = metrics.APE(metrics.PoseRelation.translation_part)
ape.process_data((truth, estimate))
print(*("%.12f" % one.get_statistic(metrics.StatisticsType.rmse) for one in (ape, rpe)))
)";

/// A winding path over hills; `scale` and `drift` add errors of scale, heading and position.
Trajectory winding(double scale, double drift) {
  Trajectory path;
  for (int k = 0; k < 2000; ++k) {
    const double t = 0.01 * k;
    const double yaw = 0.4 * std::sin(0.7 * t) + drift * t;
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
    const Eigen::Vector3d position(scale * 0.6 * t, std::sin(0.5 * t) + drift * t * t,
                                   0.2 * std::sin(t));
    path.push_back({t, position, turn, Eigen::Vector3d::Zero()});
  }
  return path;
}

TEST(Evo, AgreesAboutAbsoluteAndRelativeErrors) {
  if (std::system("python3 -c 'import evo' 2> /dev/null") != 0) {
    GTEST_SKIP() << "evo is not installed (no Debian package; `pip install evo`)";
  }
  const Trajectory truth = winding(1.0, 0.0);
  const Trajectory estimate = winding(1.02, 0.01);
  const ScratchFolder folder;
  const std::string command =
      fmt::format("python3 {} {} {}", folder.write("errors.py", script).string(),
                  folder.write("truth.tum", to_tum(truth)).string(),
                  folder.write("estimate.tum", to_tum(estimate)).string());
  const std::unique_ptr<FILE, int (*)(FILE*)> evo(::popen(command.c_str(), "r"), ::pclose);
  std::array<double, 2> errors = {};
  ASSERT_EQ(std::fscanf(evo.get(), "%lf %lf", errors.data(), &errors[1]), 2) << command;
  const TrajectoryScore score = score_trajectory(estimate, truth);
  EXPECT_NEAR(score.ate(), errors[0], 1e-6);
  EXPECT_NEAR(score.rpe(), errors[1], 1e-6);
}

}  // namespace
}  // namespace touchdown::scoring
