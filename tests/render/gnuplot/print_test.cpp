#include <algorithm>
#include <cmath>
#include <functional>
#include <regex>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "core/files.hpp"
#include "render/figures/figures.hpp"
#include "render/gnuplot/facets.hpp"
#include "render/studies/registry.hpp"
#include "tests/render/figures/noise_map.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::render {
namespace {

constexpr const char* long_name = "Bayes filter (measurement alone)";

Figure print_map(const FigureFile& file, std::size_t levels, std::size_t panels) {
  NoiseMap map{.error = [](double, double x) { return x == 0.0 ? 0.5 : 4.2; }};
  for (std::size_t i = 0; i < panels; ++i)
    map.estimators.push_back(fmt::format("{} {}", long_name, i));
  for (std::size_t i = 0; i < levels; ++i) map.torque.push_back(0.25 * static_cast<double>(i));
  map.accelerometer = map.torque;
  return map.draw(file);
}

Figure print_densities(const FigureFile& file) {
  DensityFigure figure{"Torques", {{"a filter", {}}, {"another", {}}}, "Two densities."};
  for (DensityRow& row : figure.rows) {
    row.grids.knee = {0.0, 3.0, 31};
    row.grids.wheel = {0.0, 1.0, 21};
    for (int w = 0; w < 21; ++w) {
      for (int k = 0; k < 31; ++k) {
        row.grids.contact.push_back(std::exp(-0.02 * ((k - 20) * (k - 20) + (w - 9) * (w - 9))));
        row.grids.no_contact.push_back(std::exp(-0.1 * (k * k + (w - 2) * (w - 2))));
      }
    }
  }
  return draw_density_figure(figure, file);
}

Figure print_latencies(const FigureFile& file) {
  std::string text =
      "simulator,view,torque_noise_nm,accelerometer_noise_mps2,estimator,latency_ms,"
      "takeoffs_found,landings_found\n";
  for (const char* noise : {"0,0", "1,5"}) {
    for (const char* end : {"", "2"}) {
      text +=
          fmt::format("mujoco,wheels,{0},{1}{2},-2.5,0,0.1\nmujoco,wheels,{0},{1}{2},7.5,1,0.9\n",
                      noise, long_name, end);
    }
  }
  const Table table = table_of(from_csv(text));
  return draw_facets(latency_figure(table, {}, "mujoco"), table, file).value();
}

Figure print_facets(const FigureFile& file, bool has_rows) {
  const Table table =
      table_of(from_csv("engine,estimator,noise,a,a_low,a_high,b,b_low,b_high\n"
                        "mujoco,x,1,0.5,0.4,0.6,2,1,3\nmujoco,y,1,0.6,0.5,0.7,3,2,4\n"
                        "mujoco,x,2,0.4,0.3,0.5,4,2,5\nmujoco,y,2,0.5,0.4,0.6,2,1,5\n"
                        "bullet,x,1,0.5,0.4,0.6,2,1,3\nbullet,y,1,0.6,0.5,0.7,3,2,4\n"
                        "bullet,x,2,0.4,0.3,0.5,4,2,5\nbullet,y,2,0.5,0.4,0.6,2,1,5\n"));
  const auto titled = [](const std::string& value) { return value + ", " + long_name; };
  experiments::FigureSpec spec{.name = "f", .table = "f.csv"};
  spec.panels = experiments::groups_in(table, "engine", titled);
  const auto estimators = experiments::groups_in(table, "estimator", titled);
  (has_rows ? spec.rows : spec.series) = estimators;
  spec.x = {.column = "noise", .title = "torque noise", .unit = "N·m"};
  spec.measures = {experiments::axis_with_interval("a", "success rate"),
                   experiments::axis_with_interval("b", "extra switches per minute")};
  if (has_rows) spec.marks = {{experiments::MarkShape::points, {}}};
  spec.title = "A figure of a table";
  spec.caption = "Two estimators.";
  return draw_facets(spec, table, file).value();
}

Figure print_overlay(const FigureFile& file) {
  const auto drop = [](const std::string& engine) {
    logs::Recording recording;
    recording.info.simulator = engine;
    recording.info.control_period_us = 1000;
    for (int k = 0; k < 1500; ++k) {
      models::Observation observation;
      observation.time = 1e-3 * k;
      models::GroundTruth truth;
      truth.wheel_normal_force = k > 400 && k < 700 ? std::array{0.0, 0.0} : std::array{26.0, 26.0};
      recording.observation.push_back(observation);
      recording.truth.push_back(truth);
      recording.action.emplace_back();
    }
    return recording;
  };
  DropOverlay what;
  what.title = "One drop";
  return draw_drop_overlay(drop("mujoco"), drop("bullet"), what, file);
}

struct PrintedKind {
  const char* name;
  std::function<Figure(const FigureFile&)> draw;
};

const PrintedKind kinds[] = {
    {"map_3", [](const FigureFile& file) { return print_map(file, 3, 2); }},
    {"map_6", [](const FigureFile& file) { return print_map(file, 6, 3); }},
    {"map_13", [](const FigureFile& file) { return print_map(file, 13, 4); }},
    {"densities", print_densities},
    {"latency", print_latencies},
    {"curves", [](const FigureFile& file) { return print_facets(file, false); }},
    {"rows", [](const FigureFile& file) { return print_facets(file, true); }},
    {"overlay", print_overlay},
};

/// The sizes of all texts of a drawing at its printed width (pt), by an SVG reader of its own.
std::vector<double> sizes_in_print(const std::string& svg, double width_mm) {
  std::smatch box;
  EXPECT_TRUE(std::regex_search(svg, box, std::regex("viewBox=\"0 0 ([0-9.]+) ([0-9.]+)\"")));
  const double pt_per_unit = width_mm / 25.4 * 72.0 / std::stod(box[1].str());
  const std::regex font("font-size=\"([0-9.]+)\"");
  std::vector<double> sizes;
  for (std::sregex_iterator at(svg.begin(), svg.end(), font), end; at != end; ++at) {
    sizes.push_back(pt_per_unit * std::stod((*at)[1].str()));
  }
  return sizes;
}

TEST(PrintedFigures, HaveNoTextUnderSixPoints) {
  const ScratchFolder scratch;
  for (const PrintedKind& kind : kinds) {
    for (const double width : {88.0, 180.0}) {
      for (const bool has_caption : {false, true}) {
        const std::string name = fmt::format("{}_{}_{}", kind.name, width, has_caption);
        const Figure figure = kind.draw({scratch / name, {width, has_caption}});
        const std::string svg = read_file(figure.svg);
        EXPECT_THAT(svg, ::testing::HasSubstr(fmt::format("width=\"{}mm\"", width))) << name;
        const std::vector<double> sizes = sizes_in_print(svg, width);
        ASSERT_FALSE(sizes.empty()) << name;
        EXPECT_GE(*std::min_element(sizes.begin(), sizes.end()), 5.99) << name;
        const double dots = width / 25.4 * 300.0;
        EXPECT_NEAR(cv::imread(figure.png.string()).cols, dots, 2.0) << name;
      }
    }
  }
}

TEST(PrintedFigures, LeaveTitleAndCaptionToTheDocument) {
  const ScratchFolder scratch;
  const std::string with = read_file(print_facets({scratch / "a", {88.0, true}}, false).svg);
  const std::string without = read_file(print_facets({scratch / "b", {88.0, false}}, false).svg);
  EXPECT_THAT(with, ::testing::HasSubstr("Two estimators."));
  EXPECT_THAT(without, ::testing::Not(::testing::HasSubstr("Two estimators.")));
  EXPECT_EQ(figure_text(read_file(scratch / "b.gp")).caption, "Two estimators.");
}

TEST(PrintedFigures, OnlyTheChosenOneIsDrawn) {
  const ScratchFolder scratch;
  EXPECT_TRUE(
      print_latencies({scratch / "one", {.width_mm = 88.0, .only = "another"}}).png.empty());
  EXPECT_FALSE(is_there(scratch / "one.gp"));
  EXPECT_FALSE(print_latencies({scratch / "one", {.width_mm = 88.0, .only = "one"}}).png.empty());
}

}  // namespace
}  // namespace touchdown::render
