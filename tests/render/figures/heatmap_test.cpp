#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/error.hpp"
#include "core/files.hpp"
#include "render/figures/figures.hpp"
#include "render/gnuplot/figure.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::render {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

Heatmap error_heatmap() {
  Heatmap heatmap{.title = "Success rate",
                  .x_label = "accelerometer noise (m/s²)",
                  .y_label = "torque noise (N·m)",
                  .x = {0, 1, 5},
                  .y = {0, 0.5},
                  .panels = {},
                  .caption = "2 runs"};
  heatmap.panels.push_back({.title = "MuJoCo", .value = {{1.0, 2.0, 10.0}, {3.0, 4.0, 20.0}}});
  heatmap.panels.push_back({.title = "Bullet", .value = {{1.0, 3.0, NAN}, {3.0, 6.0, 30.0}}});
  return heatmap;
}

class FigureFiles : public ::testing::Test {
 protected:
  std::vector<std::string> names() const {
    std::vector<std::string> result;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
      result.push_back(entry.path().filename().string());
    }
    return result;
  }

  const ScratchFolder scratch_;
  const std::filesystem::path folder_ = scratch_.path();
};

TEST_F(FigureFiles, AppearTogetherWithScriptAndData) {
  const Figure figure = draw_heatmap(error_heatmap(), folder_ / "heatmap");
  EXPECT_THAT(names(), ::testing::UnorderedElementsAre("heatmap.png", "heatmap.svg", "heatmap.pdf",
                                                       "heatmap.gp", "heatmap.dat"));
  EXPECT_THAT(read_file(figure.svg), AllOf(HasSubstr("torque noise"), HasSubstr(">98.00<")));
  EXPECT_EQ(read_file(figure.pdf).substr(0, 4), "%PDF");
  EXPECT_GT(cv::imread(figure.png.string()).cols, 500);
}

TEST_F(FigureFiles, AreDrawnAgainByTheScriptBesideThem) {
  draw_heatmap(error_heatmap(), folder_ / "heatmap");
  const std::string before = read_file(folder_ / "heatmap.png");
  std::filesystem::remove(folder_ / "heatmap.png");
  const std::string command = "cd '" + folder_.string() + "' && gnuplot heatmap.gp 2>/dev/null";
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_TRUE(read_file(folder_ / "heatmap.png") == before);
}

TEST_F(FigureFiles, HeatmapCrossesTheMarkedCellsOnly) {
  Heatmap heatmap = error_heatmap();
  heatmap.panels[1].marked = {{false, false, false}, {false, false, true}};
  draw_heatmap(heatmap, folder_ / "heatmap");
  const std::string data = read_file(folder_ / "heatmap.dat");
  EXPECT_THAT(data, HasSubstr("2.5\t1.5\n2.32\t1.32\n"));
  EXPECT_EQ(data.find("2.5\t1.5\n"), data.rfind("2.5\t1.5\n"));
}

/// Ends of crosses meet at the corners of small cells: there they are in the middle.
TEST_F(FigureFiles, HeatmapCrossesFineCellsInTheirMiddle) {
  Heatmap heatmap = error_heatmap();
  heatmap.x.assign(13, 0.0);
  heatmap.y.assign(13, 0.0);
  heatmap.value_label = "balanced accuracy";
  heatmap.panels = {{.title = "fine", .value = {13, std::vector<double>(13, 0.5)}}};
  heatmap.panels[0].marked.assign(13, std::vector<bool>(13, false));
  heatmap.panels[0].marked[2][4] = true;
  const Figure figure = draw_heatmap(heatmap, folder_ / "fine");
  const std::string data = read_file(folder_ / "fine.dat");
  EXPECT_THAT(data, HasSubstr("4.275\t2.275\n4\t2\n"));
  EXPECT_EQ(data.find("2.5\t1.5\n"), std::string::npos) << "no corner";
  EXPECT_THAT(read_file(figure.svg), HasSubstr("balanced accuracy (%)"));
}

/// An unknown cell must stay white, and must not move the cells after it.
TEST_F(FigureFiles, HeatmapCellsHaveTheirOwnColours) {
  Heatmap heatmap = error_heatmap();
  heatmap.panels = {{.title = "", .value = {{30.0, NAN, 0.1}, {0.0, 100.0, 0.1}}}};
  const Figure figure = draw_heatmap(heatmap, folder_ / "cells");
  const cv::Mat image = cv::imread(figure.png.string());
  // Cells are 78.7 x 95 pixels from (66, 60); the first row of values is the lower one.
  const auto colour = [&](int row, int column) {
    return image.at<cv::Vec3b>(60 + (1 - row) * 95 + 6, 66 + column * 236 / 3 + 6);
  };
  const cv::Vec3b many = colour(0, 0), few = colour(0, 2);
  EXPECT_GT(few[1], 200);  // yellow
  EXPECT_LT(many[1], 60);  // dark violet
  EXPECT_EQ(colour(0, 1), cv::Vec3b(255, 255, 255));
  // Values beyond the scale have the colour of its end.
  EXPECT_EQ(colour(1, 0), few);
  EXPECT_EQ(colour(1, 1), many);
  EXPECT_EQ(colour(1, 2), few);
}

TEST_F(FigureFiles, TextsCannotBreakOutOfTheScript) {
  Heatmap heatmap = error_heatmap();
  const std::string secret = (folder_ / "broken_out").string();
  heatmap.title = "it's \"100%\" `touch " + secret + "` {x}_y^z @a \\n # }";
  heatmap.panels[0].title = "'; system('touch " + secret + "') #";
  heatmap.caption = "line one\nline two $(touch " + secret + ")";
  const Figure figure = draw_heatmap(heatmap, folder_ / "heatmap");
  EXPECT_FALSE(std::filesystem::exists(secret));
  EXPECT_THAT(read_file(figure.svg), HasSubstr("{x}_y^z @a"));
}

TEST_F(FigureFiles, DescriptionsCannotBreakOutOfTheirComments) {
  const std::string secret = (folder_ / "broken_out").string();
  const std::string attack = "x\nsystem 'touch " + secret + "'\r\nplot\\";
  draw_figure(folder_ / "d", 300, 200, "plot x\n", {}, {attack, attack, attack});
  EXPECT_FALSE(std::filesystem::exists(secret));
  EXPECT_THAT(figure_text(read_file(folder_ / "d.gp")).alt, HasSubstr("x system 'touch"));
}

TEST_F(FigureFiles, FineMapsLeaveTheNumbersToTheDataFile) {
  Heatmap heatmap = error_heatmap();
  heatmap.x.assign(13, 0.0);
  heatmap.y.assign(13, 0.0);
  heatmap.panels = {{.title = "fine", .value = {13, std::vector<double>(13, 0.5)}}};
  heatmap.panels[0].value[3][4] = 3.987;
  heatmap.panels[0].value[4][3] = 1.0;
  const Figure figure = draw_heatmap(heatmap, folder_ / "fine");
  EXPECT_EQ(read_file(figure.svg).find(">96.01<"), std::string::npos);
  EXPECT_THAT(read_file(folder_ / "fine.dat"), HasSubstr("96.013"));
}

/// Four estimators that would look alike on a linear scale.
TEST_F(FigureFiles, HeatmapColoursDistinguishVeryGoodSuccessRates) {
  Heatmap heatmap = error_heatmap();
  heatmap.x = {0, 1, 2, 3};
  heatmap.y = {0};
  heatmap.panels = {{.title = "", .value = {{0.15, 0.25, 0.7, 1.7}}}};
  const Figure figure = draw_heatmap(heatmap, folder_ / "good");
  const cv::Mat image = cv::imread(figure.png.string());
  for (int column = 0; column + 1 < 4; ++column) {
    const auto colour = [&](int c) { return image.at<cv::Vec3b>(60 + 6, 66 + c * 60 + 6); };
    EXPECT_GT(cv::norm(colour(column), colour(column + 1)), 40.0) << column;
  }
  EXPECT_THAT(read_file(figure.svg),
              AllOf(HasSubstr(">99.85<"), HasSubstr(">99.75<"), HasSubstr(">99.30<"),
                    HasSubstr("≤ 70"), HasSubstr("≥ 99.9")));
}

TEST_F(FigureFiles, LeaveNothingAfterAnErrorOfGnuplot) {
  EXPECT_THAT([&] { draw_figure(folder_ / "bad", 300, 200, "plot 'missing.dat'\n", {}); },
              ThrowsMessage<Error>(AllOf(HasSubstr("gnuplot"), HasSubstr("missing.dat"))));
  EXPECT_TRUE(names().empty());
}

TEST_F(FigureFiles, MissingGnuplotIsOneClearError) {
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", "/nowhere", 1);
  EXPECT_THAT([&] { draw_heatmap(error_heatmap(), folder_ / "heatmap"); },
              ThrowsMessage<Error>(HasSubstr("gnuplot-nox")));
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_TRUE(names().empty());
}

TEST_F(FigureFiles, UnwritableFoldersAreNamed) {
  std::ofstream(folder_ / "file") << "in the way";
  EXPECT_THAT([&] { draw_heatmap(error_heatmap(), folder_ / "file/heatmap"); },
              ThrowsMessage<Error>(HasSubstr("cannot be written")));
}

TEST_F(FigureFiles, ConstantAndUnknownHeatmapsCanBeDrawn) {
  Heatmap heatmap = error_heatmap();
  heatmap.x = {0};
  heatmap.y = {0};
  heatmap.panels = {{.title = "one", .value = {{0.0}}}, {.title = "none", .value = {{NAN}}}};
  EXPECT_TRUE(std::filesystem::exists(draw_heatmap(heatmap, folder_ / "one").png));
}

TEST(FigureText, WrapsByLettersNotBytes) {
  EXPECT_EQ(wrapped("aaa bbb ccc", 7), "aaa bbb\nccc");
  EXPECT_EQ(wrapped("äää äää ccc", 7), "äää äää\nccc");
  EXPECT_EQ(wrapped("", 7), "");
  EXPECT_EQ(wrapped("averylongword b", 4), "averylongword\nb");
}

}  // namespace
}  // namespace touchdown::render
