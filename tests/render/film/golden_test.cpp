#include "tests/render/film/golden.hpp"

#include <cmath>
#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/rows.hpp"
#include "experiments/config/experiment.hpp"
#include "render/figures/figures.hpp"
#include "render/gnuplot/facets.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::render {
namespace {

/// Errors that grow with both noises.
Heatmap heatmap() {
  Heatmap map{.title = "Success rate",
              .x_label = "accelerometer noise (m/s²)",
              .y_label = "torque noise (N·m)",
              .x = {0, 1, 3, 5, 7},
              .y = {0, 0.5, 1, 2},
              .panels = {{.title = "an estimator", .value = {}}},
              .caption = "4 runs; crossed cells do not beat a constant answer."};
  for (const double y : map.y) {
    map.panels[0].value.emplace_back();
    map.panels[0].marked.emplace_back();
    for (const double x : map.x) {
      map.panels[0].value.back().push_back(1.0 + 0.2 * x * x + 2.0 * y * y);
      map.panels[0].marked.back().push_back(map.panels[0].value.back().back() > 10.0);
    }
  }
  return map;
}

/// Two Gaussians.
DensityFigure densities(double width_in_the_air = 0.12) {
  DensityFigure figure{"Torques", {{"a filter", {}}}, "Two normal distributions."};
  LikelihoodGrids& grids = figure.rows[0].grids;
  grids.knee = {0.0, 3.0, 61};
  grids.wheel = {0.0, 1.0, 41};
  for (int w = 0; w < grids.wheel.count; ++w) {
    for (int k = 0; k < grids.knee.count; ++k) {
      const auto gauss = [&](double knee, double wheel, double knee_width, double wheel_width) {
        const double u = (grids.knee[k] - knee) / knee_width;
        const double v = (grids.wheel[w] - wheel) / wheel_width;
        return std::exp(-0.5 * (u * u + v * v)) / (knee_width * wheel_width);
      };
      grids.contact.push_back(gauss(1.6, 0.4, 0.3, 0.12));
      grids.no_contact.push_back(gauss(0.3, 0.1, width_in_the_air, 0.08));
    }
  }
  return figure;
}

/// Three estimators, of which one may be missing.
Table reliability(const std::string& without = {}) {
  std::string text =
      "simulator,view,torque_noise_nm,accelerometer_noise_mps2,estimator,steps,mean_probability,"
      "contact_frequency,contact_frequency_low,contact_frequency_high\n";
  double power = 0.5;
  for (const std::string estimator : {"robust", "paper", "load_filter"}) {
    for (int bin = 0; bin < 10 && estimator != without; ++bin) {
      const double p = 0.1 * bin + 0.05;
      const double share = std::pow(p, power);
      text += fmt::format("mujoco,wheels,0,0,{},{},{},{},{},{}\n", estimator, 10 * (bin + 1), p,
                          share, share - 0.04, share + 0.04);
    }
    power += 0.5;
  }
  return table_of(from_csv(text));
}

Figure reliability_of(const Table& table, const std::filesystem::path& stem) {
  experiments::Experiment experiment;
  experiment.estimators = {"robust", "paper", "load_filter"};
  return draw_facets(reliability_figure(table, experiment, "mujoco"), table, stem).value();
}

ScoreFigure latencies() {
  ScoreFigure figure{"Latency", {{"no noise", std::vector<ScoreRow>(2)}}, "4 runs."};
  figure.panels[0].rows[0].name = "first";
  figure.panels[0].rows[1].name = "second";
  figure.panels[0].rows[1].line_type = 2;
  for (int i = 0; i < 60; ++i) {
    for (std::size_t r = 0; r < 2; ++r) {
      ScoreRow& row = figure.panels[0].rows[r];
      const auto spread = static_cast<std::int64_t>(i % 10 + i % 7 - 8);
      const auto delay = static_cast<std::int64_t>(20 * (1 + r)) + 2 * spread;
      row.takeoff.add({scoring::EventKind::takeoff, scoring::Judgement::detected, 0, delay}, 1000);
      row.landing.add({scoring::EventKind::landing, scoring::Judgement::detected, 0, spread}, 1000);
    }
  }
  return figure;
}

class Golden : public ::testing::Test {
 protected:
  /// How far a figure is from its golden copy.
  PictureDifference compared(const std::string& name, const Figure& figure) const {
    const cv::Mat golden = golden_picture(name + ".png", figure.png);
    EXPECT_FALSE(golden.empty()) << name;
    return difference(cv::imread(figure.png.string()), golden);
  }
  void expect_same(const std::string& name, const Figure& figure) const {
    const PictureDifference apart = compared(name, figure);
    EXPECT_TRUE(same_picture(apart)) << name << ": mean " << apart.mean << ", worst tile "
                                     << apart.worst_tile << ", similarity " << apart.similarity;
  }
  std::filesystem::path stem(const char* name) const { return scratch_ / name; }

  const ScratchFolder scratch_;
};

TEST_F(Golden, FiguresLookLikeTheirCopies) {
  expect_same("heatmap", draw_heatmap(heatmap(), stem("heatmap")));
  expect_same("densities", draw_density_figure(densities(), stem("densities")));
  expect_same("reliability", reliability_of(reliability(), stem("reliability")));
  expect_same("latency", draw_latency_figure(latencies(), stem("latency")));
}

/// The comparison above must be able to fail: each figure is drawn once with other content.
TEST_F(Golden, OtherContentIsNoticed) {
  if (std::getenv("TOUCHDOWN_UPDATE_GOLDEN") != nullptr) GTEST_SKIP() << "copies are being made";
  Heatmap another_cell = heatmap();
  another_cell.panels[0].value[1][1] = 4.5;
  EXPECT_FALSE(same_picture(compared("heatmap", draw_heatmap(another_cell, stem("cell")))));

  EXPECT_FALSE(
      same_picture(compared("reliability", reliability_of(reliability("paper"), stem("curve")))));

  DensityFigure wider = densities(0.16);
  EXPECT_FALSE(same_picture(compared("densities", draw_density_figure(wider, stem("wider")))));

  ScoreFigure without_a_histogram = latencies();
  without_a_histogram.panels[0].rows[1].landing = {};
  EXPECT_FALSE(same_picture(
      compared("latency", draw_latency_figure(without_a_histogram, stem("histogram")))));
}

}  // namespace
}  // namespace touchdown::render
