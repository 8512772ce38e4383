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
#include "tests/render/figures/noise_map.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::render {
namespace {

/// Errors that grow with both noises.
NoiseMap heatmap() {
  return {.estimators = {"an estimator"},
          .torque = {0, 0.5, 1, 2},
          .accelerometer = {0, 1, 3, 5, 7},
          .error = [](double y, double x) { return 1.0 + 0.2 * x * x + 2.0 * y * y; }};
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

experiments::Experiment three_estimators() {
  experiments::Experiment experiment;
  experiment.estimators = {"robust", "paper", "load_filter"};
  return experiment;
}

/// Three estimators, of which one may be missing.
Table reliability(const std::string& without = {}) {
  std::string text =
      "simulator,view,torque_noise_nm,accelerometer_noise_mps2,estimator,steps,mean_probability,"
      "contact_frequency,contact_frequency_low,contact_frequency_high\n";
  double power = 0.5;
  for (const std::string& estimator : three_estimators().estimators) {
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
  return draw_facets(reliability_figure(table, three_estimators(), "mujoco"), table, stem).value();
}

/// Distributions of the three, which find 95 % of the takeoffs and these shares of the landings.
Figure latencies_of(double landings, const std::filesystem::path& stem) {
  std::string text =
      "simulator,view,torque_noise_nm,accelerometer_noise_mps2,estimator,latency_ms,"
      "takeoffs_found,landings_found\n";
  double delay = 0.0;
  for (const std::string& estimator : three_estimators().estimators) {
    for (double latency = -37.5; latency < 70.0; latency += 5.0) {
      const auto found = [&](double width) {
        return 0.5 + 0.5 * std::tanh((latency - delay) / width);
      };
      text += fmt::format("mujoco,wheels,0,0,{},{},{},{}\n", estimator, latency, 0.95 * found(20.0),
                          landings * found(5.0));
    }
    delay += 10.0;
  }
  const Table table = table_of(from_csv(text));
  return draw_facets(latency_figure(table, three_estimators(), "mujoco"), table, stem).value();
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
  expect_same("heatmap", heatmap().draw(stem("heatmap")));
  expect_same("densities", draw_density_figure(densities(), stem("densities")));
  expect_same("reliability", reliability_of(reliability(), stem("reliability")));
  expect_same("latency", latencies_of(0.7, stem("latency")));
}

/// The comparison above must be able to fail: each figure is drawn once with other content.
TEST_F(Golden, OtherContentIsNoticed) {
  if (std::getenv("TOUCHDOWN_UPDATE_GOLDEN") != nullptr) GTEST_SKIP() << "copies are being made";
  NoiseMap another_cell = heatmap();
  another_cell.error = [](double y, double x) {
    return y == 0.5 && x == 1.0 ? 4.5 : heatmap().error(y, x);
  };
  EXPECT_FALSE(same_picture(compared("heatmap", another_cell.draw(stem("cell")))));

  EXPECT_FALSE(
      same_picture(compared("reliability", reliability_of(reliability("paper"), stem("curve")))));

  DensityFigure wider = densities(0.16);
  EXPECT_FALSE(same_picture(compared("densities", draw_density_figure(wider, stem("wider")))));

  EXPECT_FALSE(same_picture(compared("latency", latencies_of(0.5, stem("fewer")))));
}

}  // namespace
}  // namespace touchdown::render
