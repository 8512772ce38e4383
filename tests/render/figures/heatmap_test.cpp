#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/error.hpp"
#include "core/files.hpp"
#include "render/gnuplot/figure.hpp"
#include "tests/render/figures/noise_map.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::render {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// Errors from 1 to 30 %.
NoiseMap error_map() {
  return {.estimators = {"one", "another"},
          .torque = {0, 0.5},
          .accelerometer = {0, 1, 5},
          .error = [](double y, double x) { return 1.0 + 2.0 * y + x * (1.0 + y); }};
}

/// With one losing cell.
NoiseMap fine_map() {
  NoiseMap map{.estimators = {"one"}};
  for (int i = 0; i < 13; ++i) map.torque.push_back(i);
  map.accelerometer = map.torque;
  map.error = [](double y, double x) { return y == 3.0 && x == 4.0 ? 3.987 : 0.5; };
  map.always_contact = 98.0;
  return map;
}

/// The cells of a figure's panels by the margins in its script.
class DrawnCells {
 public:
  DrawnCells(const Figure& figure, int columns, int rows)
      : picture_(cv::imread(figure.png.string())), columns_(columns), rows_(rows) {
    const std::string script =
        read_file(std::filesystem::path(figure.png).replace_extension(".gp"));
    const std::regex margin("set [lrtb]margin at screen (.*)\n");
    for (std::sregex_iterator at(script.begin(), script.end(), margin), end; at != end; ++at) {
      margins_.push_back(std::stod((*at)[1].str()));
    }
  }

  /// The colour at a place within a cell, as shares of its size from its lower left corner.
  cv::Vec3b at(std::size_t panel, int column, int row, double x, double y) const {
    const double* const margin = &margins_.at(4 * panel);  // left, right, top, bottom
    const double across = margin[0] + (margin[1] - margin[0]) * (column + x) / columns_;
    const double up = margin[3] + (margin[2] - margin[3]) * (row + y) / rows_;
    return picture_.at<cv::Vec3b>(static_cast<int>((1.0 - up) * picture_.rows),
                                  static_cast<int>(across * picture_.cols));
  }
  /// Whether a line in white passes this place, give or take a few pixels.
  bool is_crossed(std::size_t panel, int column, int row, double x, double y) const {
    for (int i = -2; i <= 2; ++i) {
      for (int j = -2; j <= 2; ++j) {
        const cv::Vec3b colour = at(panel, column, row, x + 0.01 * i, y + 0.01 * j);
        if (colour[0] > 180 && colour[1] > 180) return true;
      }
    }
    return false;
  }
  /// Beside texts and crosses.
  cv::Vec3b colour(int column, int row) const { return at(0, column, row, 0.5, 0.1); }

 private:
  cv::Mat picture_;
  int columns_, rows_;
  std::vector<double> margins_;
};

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
  const Figure figure = error_map().draw(folder_ / "heatmap");
  EXPECT_THAT(names(), ::testing::UnorderedElementsAre("heatmap.png", "heatmap.svg", "heatmap.pdf",
                                                       "heatmap.gp", "heatmap.dat"));
  EXPECT_THAT(read_file(figure.svg), AllOf(HasSubstr("torque noise (N·m)"), HasSubstr(">98.00<"),
                                           HasSubstr("success rate (%)")));
  EXPECT_EQ(read_file(figure.pdf).substr(0, 4), "%PDF");
  EXPECT_GT(cv::imread(figure.png.string()).cols, 500);
}

TEST_F(FigureFiles, AreDrawnAgainByTheScriptBesideThem) {
  error_map().draw(folder_ / "heatmap");
  const std::string before = read_file(folder_ / "heatmap.png");
  std::filesystem::remove(folder_ / "heatmap.png");
  const std::string command = "cd '" + folder_.string() + "' && gnuplot heatmap.gp 2>/dev/null";
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_TRUE(read_file(folder_ / "heatmap.png") == before);
}

/// Only the upper right cell has an error of 10 % or more, as always contact has.
TEST_F(FigureFiles, HeatmapCrossesTheLosingCellsOnly) {
  NoiseMap map = error_map();
  map.error = [](double y, double x) { return y + x > 5.0 ? 10.0 : 9.0; };
  const DrawnCells cells(map.draw(folder_ / "heatmap"), 3, 2);
  for (std::size_t panel = 0; panel < 2; ++panel) {
    for (int row = 0; row < 2; ++row) {
      for (int column = 0; column < 3; ++column) {
        for (const double x : {0.1, 0.9}) {
          for (const double y : {0.1, 0.9}) {
            EXPECT_EQ(cells.is_crossed(panel, column, row, x, y), row == 1 && column == 2);
          }
        }
      }
    }
  }
}

/// Ends of crosses meet at the corners of small cells: there they are in the middle.
TEST_F(FigureFiles, HeatmapCrossesFineCellsInTheirMiddle) {
  const DrawnCells cells(fine_map().draw(folder_ / "fine"), 13, 13);
  EXPECT_TRUE(cells.is_crossed(0, 4, 3, 0.5, 0.5));
  EXPECT_FALSE(cells.is_crossed(0, 4, 3, 0.1, 0.1));
  EXPECT_FALSE(cells.is_crossed(0, 3, 4, 0.5, 0.5));
}

/// An unknown cell must stay white, and must not move the cells after it.
TEST_F(FigureFiles, HeatmapCellsHaveTheirOwnColours) {
  NoiseMap map = error_map();
  map.estimators = {"one"};
  map.error = [](double y, double x) {
    return y == 0.0 ? (x == 0.0   ? 30.0
                       : x == 1.0 ? NAN
                                  : 0.1)
                    : (x == 0.0   ? 0.0
                       : x == 1.0 ? 100.0
                                  : 0.1);
  };
  map.always_contact = 0.0;
  const Figure figure = map.draw(folder_ / "cells");
  const DrawnCells cells(figure, 3, 2);
  const cv::Vec3b many = cells.colour(0, 0), few = cells.colour(2, 0);
  EXPECT_GT(few[1], 200);  // yellow
  EXPECT_LT(many[1], 60);  // dark violet
  EXPECT_EQ(cells.colour(1, 0), cv::Vec3b(255, 255, 255));
  // Values beyond the scale have the colour of its end.
  EXPECT_EQ(cells.colour(0, 1), few);
  EXPECT_EQ(cells.colour(1, 1), many);
  EXPECT_EQ(cells.colour(2, 1), few);
  EXPECT_THAT(read_file(figure.svg),
              AllOf(HasSubstr(">–<"), HasSubstr(">100.00<"), HasSubstr(">0.00<")));
}

/// Letters are white on dark colours and dark on light ones.
TEST_F(FigureFiles, HeatmapNumbersStandOutFromTheirCells) {
  NoiseMap map = error_map();
  map.estimators = {"one"};
  map.torque = {0};
  map.accelerometer = {0, 1};
  map.error = [](double, double x) { return x == 0.0 ? 2.6 : 2.4; };
  const std::string svg = read_file(map.draw(folder_ / "letters").svg);
  const auto is_dark = [&](const char* number) {
    const std::string before = svg.substr(0, svg.find(number));
    return before.substr(before.rfind("fill=\"")).starts_with("fill=\"rgb(16,20,24)\"");
  };
  EXPECT_FALSE(is_dark(">97.40<"));
  EXPECT_TRUE(is_dark(">97.60<"));
}

TEST_F(FigureFiles, TextsCannotBreakOutOfTheScript) {
  const std::string secret = (folder_ / "broken_out").string();
  NoiseMap map = error_map();
  map.estimators[0] = "'; system('touch " + secret + "') #";
  experiments::FigureSpec spec = map.spec();
  spec.title = "it's \"100%\" `touch " + secret + "` {x}_y^z @a \\n # }";
  spec.caption = "line one\nline two $(touch " + secret + ")";
  spec.y.title = "'.system('touch " + secret + "').'";
  const Figure figure = draw_facets(spec, map.cells(), folder_ / "heatmap").value();
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
  const Figure figure = fine_map().draw(folder_ / "fine");
  EXPECT_EQ(read_file(figure.svg).find(">96.01<"), std::string::npos);
  EXPECT_THAT(read_file(folder_ / "fine.dat"), HasSubstr(",3,4,0.960130,"));
}

TEST_F(FigureFiles, HeatmapCellsHaveIntervalsWhereTheyHaveRoom) {
  NoiseMap map = error_map();
  map.half_width = 0.25;
  EXPECT_THAT(read_file(map.draw(folder_ / "wide").svg), HasSubstr(">97.75–98.25<"));
  map.accelerometer = {0, 1, 2, 3, 4};
  EXPECT_THAT(read_file(map.draw({folder_ / "narrow", {.width_mm = 88.0}}).svg),
              AllOf(HasSubstr(">98.00<"), ::testing::Not(HasSubstr("98.25"))));
}

/// Four estimators that would look alike on a linear scale.
TEST_F(FigureFiles, HeatmapColoursDistinguishVeryGoodSuccessRates) {
  NoiseMap map{.estimators = {"one"}, .torque = {0}, .accelerometer = {0, 1, 2, 3}};
  map.error = [](double, double x) {
    return std::array{0.15, 0.25, 0.7, 1.7}.at(static_cast<std::size_t>(x));
  };
  const Figure figure = map.draw(folder_ / "good");
  const DrawnCells cells(figure, 4, 1);
  for (int column = 0; column + 1 < 4; ++column) {
    EXPECT_GT(cv::norm(cells.colour(column, 0), cells.colour(column + 1, 0)), 40.0) << column;
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
  EXPECT_THAT([&] { error_map().draw(folder_ / "heatmap"); },
              ThrowsMessage<Error>(HasSubstr("gnuplot-nox")));
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_TRUE(names().empty());
}

TEST_F(FigureFiles, UnwritableFoldersAreNamed) {
  std::ofstream(folder_ / "file") << "in the way";
  EXPECT_THAT([&] { error_map().draw(folder_ / "file/heatmap"); },
              ThrowsMessage<Error>(HasSubstr("cannot be written")));
}

TEST_F(FigureFiles, MapsOfOneCellCanBeDrawnAndPanelsOfUnknownOnes) {
  NoiseMap map = error_map();
  map.torque = map.accelerometer = {0};
  EXPECT_TRUE(std::filesystem::exists(map.draw(folder_ / "one").png));
  Table cells = map.cells();
  cells.rows[1][4] = "nan";
  const Figure figure = draw_facets(map.spec(), cells, folder_ / "unknown").value();
  EXPECT_THAT(read_file(figure.svg), AllOf(HasSubstr(">99.00<"), HasSubstr(">–<")));
}

}  // namespace
}  // namespace touchdown::render
