#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "core/error.hpp"
#include "core/files.hpp"
#include "render/figures/figures.hpp"
#include "tests/render/figures/placed_texts.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::render {
namespace {

using ::testing::HasSubstr;

namespace fs = std::filesystem;

constexpr std::size_t drop_steps = 81;
const std::vector<std::string> drawn_estimators = {"robust", "load_filter"};

experiments::SpectrumTrace staged_spectrum(double level) {
  experiments::SpectrumTrace trace;
  for (std::size_t k = 0; k < drop_steps; ++k) {
    const double x = static_cast<double>(k) / drop_steps;
    trace.acceleration.push_back(level * std::sin(60.0 * x));
    trace.power.push_back(level * level);
    trace.median_frequency.push_back(300.0 * x);
    trace.p_switch.push_back(x);
    trace.p_takeoff.push_back(0.25 * x);
    trace.p_landing.push_back(0.75 * x);
    if (k % experiments::spectrum_stride == 0) trace.spectrum.emplace_back(65, level);
  }
  return trace;
}

/// Off the ground from 0 to 30 ms, with made-up beliefs.
experiments::DropDetail staged_detail(std::size_t settings) {
  experiments::DropDetail detail;
  detail.simulator = "mujoco";
  for (std::size_t k = 0; k < drop_steps; ++k) {
    const double time = 1e-3 * (static_cast<double>(k) - 20.0);
    const bool air = time >= 0.0 && time < 0.03;
    detail.time.push_back(time);
    detail.height.push_back(air ? -4.9 * time * time : 0.0);
    detail.contact.push_back(air ? 0 : 1);
    detail.torque.knee.push_back(air ? 0.0 : 1.3);
    detail.torque.wheel.push_back(air ? 0.0 : 0.2);
  }
  detail.bin_width = 1000.0 / 128.0;
  detail.transition_of = "robust";
  detail.switch_power = 50.0;
  detail.spectrum = staged_spectrum(0.1);
  for (std::size_t i = 0; i < settings; ++i) {
    experiments::NoisyDrop drop{{1.0 + static_cast<double>(i), 5.0},
                                detail.torque,
                                std::vector<double>(drop_steps, 3.0),
                                staged_spectrum(10.0),
                                {}};
    for (const auto& [name, title] :
         {std::pair("robust", "Bayes filter"), std::pair("load_filter", "Load filter")}) {
      drop.beliefs.push_back({name, title, std::vector<double>(drop_steps, 0.9)});
    }
    detail.noisy.push_back(drop);
  }
  return detail;
}

/// The numbers of a data file, line by line, without comments; NaN for all other words.
std::vector<std::vector<double>> numbers_in(const fs::path& path) {
  std::vector<std::vector<double>> rows;
  std::istringstream lines(read_file(path));
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] == '#') continue;
    rows.emplace_back();
    std::istringstream words(line);
    for (std::string word; std::getline(words, word, '\t');) {
      char* end = nullptr;
      const double value = std::strtod(word.c_str(), &end);
      rows.back().push_back(end == word.c_str() + word.size() ? value : NAN);
    }
  }
  return rows;
}

class DropFigures : public ::testing::Test {
 protected:
  const ScratchFolder scratch_;
  const fs::path folder_ = scratch_.path();
};

TEST_F(DropFigures, DetailIsAsWideAsAScreenWithItsDataBesideIt) {
  const Figure figure = draw_drop_detail(staged_detail(2), drawn_estimators,
                                         {"One drop", "Run 0.", "Curves."}, folder_ / "detail");
  const cv::Mat image = cv::imread(figure.png.string());
  EXPECT_EQ(image.cols, 1280);
  for (const char* text : {"One drop", "P(contact)", "knee torque", "torques 2 N·m", "Load filter",
                           "median frequency", "takeoff", "time since takeoff"}) {
    EXPECT_THAT(read_file(figure.svg), HasSubstr(text));
  }
  // Pictures lie inside the drawing, not beside it.
  EXPECT_THAT(read_file(figure.svg), HasSubstr("data:image/png;base64"));
  for (const auto& entry : fs::directory_iterator(folder_)) {
    const std::string name = entry.path().filename().string();
    EXPECT_EQ(name.find("image"), std::string::npos) << name;
  }
  const auto columns = numbers_in(folder_ / "detail_2.dat");
  ASSERT_EQ(columns.size(), drop_steps);
  for (const auto& row : columns) {
    ASSERT_EQ(row.size(), 17U + 2U);
    for (const double value : row) EXPECT_TRUE(std::isfinite(value));
  }
  EXPECT_EQ(columns.front()[0], -20.0);
  EXPECT_THAT(read_file(folder_ / "detail_2.dat"), HasSubstr("# time_ms\tcontact\theight_m\t"));
  const auto spectrum = numbers_in(folder_ / "detail_spectrum_1.dat");
  ASSERT_EQ(spectrum.size(), 65U);  // eight octaves of eight rows, both ends
  for (const auto& row : spectrum) {
    ASSERT_EQ(row.size(), 41U);
    EXPECT_EQ(row[7], 10.0);  // dB of 10 m²/s⁴
  }
}

TEST_F(DropFigures, SpectrogramRowsAreTheNearestBins) {
  experiments::SpectrumTrace trace;
  std::vector<double> column;
  for (int bin = 0; bin < 65; ++bin) column.push_back(std::pow(10.0, bin));
  trace.spectrum = {column};
  const double bin_width = 1000.0 / 128.0;
  std::istringstream lines(spectrum_text(trace, bin_width));
  std::string line;
  std::getline(lines, line);  // the comment
  for (int row = 0; std::getline(lines, line); ++row) {
    const double frequency = std::exp2(1.0 + row / 8.0);
    const double bin = std::min(64.0, std::round(frequency / bin_width));
    EXPECT_EQ(std::stod(line), 10.0 * bin) << frequency;
  }
}

TEST_F(DropFigures, DetailIsDrawnAgainByTheScriptBesideIt) {
  draw_drop_detail(staged_detail(1), drawn_estimators, {"it's `x` @a", "100 % {x}_y", ""},
                   folder_ / "detail");
  const std::string before = read_file(folder_ / "detail.png");
  fs::remove(folder_ / "detail.png");
  const std::string command = "cd '" + folder_.string() + "' && gnuplot detail.gp 2>/dev/null";
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_TRUE(read_file(folder_ / "detail.png") == before);
}

TEST_F(DropFigures, DetailOfUglyDataIsStillAFigure) {
  experiments::DropDetail detail = staged_detail(3);
  for (experiments::NoisyDrop& drop : detail.noisy) {
    drop.torque.knee[5] = NAN;
    std::fill(drop.torque.wheel.begin(), drop.torque.wheel.end(), 0.0);
    drop.spectrum.median_frequency[7] = 0.0;
    std::fill(drop.spectrum.power.begin(), drop.spectrum.power.end(), 0.0);
    for (auto& column : drop.spectrum.spectrum) std::fill(column.begin(), column.end(), 0.0);
  }
  std::fill(detail.torque.wheel.begin(), detail.torque.wheel.end(), 0.0);
  std::fill(detail.height.begin(), detail.height.end(), 0.0);
  std::fill(detail.contact.begin(), detail.contact.end(), std::uint8_t{0});
  const Figure figure =
      draw_drop_detail(detail, drawn_estimators, {"Ugly", "", ""}, folder_ / "ugly");
  EXPECT_GT(cv::imread(figure.png.string()).cols, 1280);
  EXPECT_THAT(read_file(folder_ / "ugly_1.dat"), HasSubstr("NaN"));
}

TEST_F(DropFigures, DetailWithColumnsOfDifferentLengthsIsRefused) {
  experiments::DropDetail detail = staged_detail(1);
  detail.height.pop_back();
  EXPECT_THROW(draw_drop_detail(detail, drawn_estimators, {}, folder_ / "detail"), Error);
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(DropFigures, PrintedInAColumnHaveTextsInsideThatDoNotTouch) {
  const FigureFile detail{folder_ / "detail", {88.0, false}};
  experiments::DropDetail drops = staged_detail(2);
  for (auto& drop : drops.noisy) {
    drop.beliefs.insert(drop.beliefs.begin(), {"reference", "Bayes filter (reference)",
                                               std::vector<double>(drop_steps, 0.8)});
  }
  const FigureText text{"One drop", "Run 0.", "Curves."};
  expect_texts_inside_and_apart(
      draw_drop_detail(drops, {"reference", "robust", "load_filter"}, text, detail).svg);
}

}  // namespace
}  // namespace touchdown::render
