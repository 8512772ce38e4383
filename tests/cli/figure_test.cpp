#include <regex>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.hpp"

namespace touchdown::cli {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

using PrintedFigure = InFolder;

TEST_F(PrintedFigure, IsDrawnAgainAtItsWidthAndChangesNothingElse) {
  write_finished_run(folder_, "--no-video");
  const std::string manifest = folder_.text("a/manifest.json");
  const std::string other = folder_.text("a/figures/error_bullet.svg");
  const std::string table = folder_.text("a/tables/results.csv");
  const std::string printed = folder_.output_of("report a --figure error_mujoco --width 8.8cm");
  EXPECT_THAT(printed, AllOf(HasSubstr("Success rate"), HasSubstr("a/figures/error_mujoco.pdf")));
  EXPECT_THAT(folder_.text("a/figures/error_mujoco.svg"), HasSubstr("width=\"88mm\""));
  EXPECT_EQ(folder_.text("a/figures/error_bullet.svg"), other);
  EXPECT_EQ(folder_.text("a/tables/results.csv"), table);
  const std::regex command("\"command\": \"[^\"]*\"");
  std::smatch before, after;
  const std::string now = folder_.text("a/manifest.json");
  ASSERT_TRUE(std::regex_search(manifest, before, command));
  ASSERT_TRUE(std::regex_search(now, after, command));
  EXPECT_EQ(after.str(), before.str());
}

TEST_F(PrintedFigure, IsAskedForByAnExperimentOfTheSameId) {
  write_finished_run(folder_, "--no-video");
  const std::string config = folder_.text("a/config.yaml");
  folder_.output_of("run tiny.yaml --no-video --out a --set figures.width_mm=88");
  EXPECT_THAT(folder_.text("a/figures/error_mujoco.svg"), HasSubstr("width=\"88mm\""));
  EXPECT_EQ(folder_.text("a/config.yaml"), config);
}

TEST_F(PrintedFigure, KeepsTheMetricOfItsRun) {
  write_finished_run(folder_, "--no-video --set figures.heatmap=balanced_accuracy");
  for (const char* width : {"88mm", "80mm"}) {
    EXPECT_THAT(folder_.output_of(std::string("report a --figure error_mujoco --width ") + width),
                HasSubstr("Balanced accuracy"));
  }
}

TEST_F(PrintedFigure, IsRefusedInOneLineWithTheNearestName) {
  write_finished_run(folder_, "--no-video");
  const char* const range = "expected 40 to 400 mm with the unit mm, cm or in, as in 88mm";
  folder_.expect_refusals(
      {{"report a --figure error_mujoco --width 88", {"--width 88: ", range}},
       {"report a --figure error_mujoco --width 5mm", {"--width 5mm: ", range}},
       {"report a --figure error_mujoco --width 88cmm",
        {"--width 88cmm: ", range, "did you mean 'mm'?"}},
       {"report a --figure error_mujoco --width wide", {"--width wide: ", range}},
       {"report a --figure error_mujoco", {"--figure: expected --width"}},
       {"report a --figure error_mujoco --width 88mm --no-video", {"no option of the page"}},
       {"report a --width 88mm", {"expected --figure NAME"}},
       {"report a --figure eror_mujoco --width 88mm",
        {"a: has no figure 'eror_mujoco'", "did you mean 'error_mujoco'?"}},
       {"report b --figure error_mujoco --width 88mm", {"b: no run directory of an experiment"}},
       {"run tiny.yaml --set figures.widht_mm=88", {"did you mean 'width_mm'?"}},
       {"run tiny.yaml --set figures.width_mm=5", {"figures.width_mm", "40", "400"}}});
}

}  // namespace
}  // namespace touchdown::cli
