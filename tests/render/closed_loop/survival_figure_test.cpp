#include "render/closed_loop/survival_figure.hpp"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::render {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

const std::vector<std::string> estimators = {"robust", "phase"};

const char* const header =
    "simulator,scenario,policy,contact,rise_m,runs,finished,finished_low,finished_high,varied,key,"
    "value,delay_ms,torque_noise_nm,sensors,landing_speed_rms_mps,false_takeoffs_per_minute\n";

std::string row(const std::string& scene, const std::string& contact, const std::string& varied,
                const std::string& value, const std::string& speed) {
  return "mujoco," + scene + ",soft_landing," + contact + ",nan,8,0.75,0.35,0.97," + varied +
         ",k," + value + ",20,1,upkie," + speed + ",0\n";
}

TEST(SurvivalFigure, HasACurvePerContactSourceOverTheVariedQuantity) {
  const ScratchFolder folder;
  std::filesystem::create_directories(folder / "tables");
  folder.write("tables/survival.csv", header + row("stairs", "truth", "rise", "0.5", "0.2") +
                                          row("stairs", "truth", "rise", "0.7", "0.3") +
                                          row("stairs", "phase", "rise", "0.5", "0.2") +
                                          row("stairs", "phase", "rise", "0.7", "nan"));
  draw_survival_figures(folder.path(), estimators, 0.95);
  const auto stem = folder / "figures/survival_stairs_soft_landing_rise";
  for (const char* kind : {".png", ".svg", ".pdf"}) {
    EXPECT_TRUE(std::filesystem::exists(stem.string() + kind)) << kind;
  }
  const std::string script = read_file(stem.string() + ".gp");
  EXPECT_THAT(script, AllOf(HasSubstr("Truth (oracle)"), HasSubstr("Phase filter"),
                            HasSubstr("height of a step (m)"), HasSubstr("8 runs per point")));
}

TEST(SurvivalFigure, WithoutAVariedQuantityHasARowPerContactSourceAndOmitsMissingMeasures) {
  const ScratchFolder folder;
  std::filesystem::create_directories(folder / "tables");
  folder.write("tables/survival.csv", header + row("put_down", "truth", "", "nan", "0.05") +
                                          row("put_down", "always", "", "nan", "1.6") +
                                          row("roam", "truth", "", "nan", "nan"));
  draw_survival_figures(folder.path(), estimators, 0.95);
  const std::string landings = "set xlabel 'tyre speed at landings (m/s)'";
  EXPECT_THAT(read_file(folder / "figures/survival_put_down_soft_landing.gp"),
              AllOf(HasSubstr(landings), HasSubstr("Always contact")));
  EXPECT_THAT(read_file(folder / "figures/survival_roam_soft_landing.gp"),
              Not(HasSubstr("set xlabel 'tyre")));
}

TEST(SurvivalFigure, DelayIsInMilliseconds) {
  const ScratchFolder folder;
  std::filesystem::create_directories(folder / "tables");
  folder.write("tables/survival.csv", header + row("stairs", "truth", "delay", "nan", "0.05"));
  const auto points = survival_points(folder.path());
  ASSERT_EQ(points.size(), 1U);
  EXPECT_EQ(points.front().at, 20.0);
}

TEST(SurvivalFigure, WithoutATableThereIsNone) {
  const ScratchFolder folder;
  EXPECT_THAT(survival_points(folder.path()), IsEmpty());
  draw_survival_figures(folder.path(), estimators, 0.95);
  EXPECT_FALSE(std::filesystem::exists(folder / "figures"));
}

}  // namespace
}  // namespace touchdown::render
