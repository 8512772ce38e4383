#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "render/figures/figures.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::render {
namespace {

/// A Gaussian around (knee, wheel) of width (0.2, 0.1) N·m.
std::vector<double> gaussian(const Axis& knee, const Axis& wheel, double knee_mean,
                             double wheel_mean) {
  std::vector<double> grid;
  for (int w = 0; w < wheel.count; ++w) {
    for (int k = 0; k < knee.count; ++k) {
      const double u = (knee[k] - knee_mean) / 0.2, v = (wheel[w] - wheel_mean) / 0.1;
      grid.push_back(std::exp(-0.5 * (u * u + v * v)));
    }
  }
  return grid;
}

LikelihoodGrids model() {
  const Axis knee{0.0, 4.0, 201}, wheel{0.0, 2.0, 201};
  return {knee, wheel, gaussian(knee, wheel, 2.0, 1.0), gaussian(knee, wheel, 1.0, 0.5)};
}

/// In a planar normal distribution, the ellipse with densities above c times the peak encloses a
/// share of 1 − c.
TEST(DensityLevel, EnclosesTheShareOfANormalDistribution) {
  const LikelihoodGrids grids = model();
  for (const double share : {0.5, 0.9, 0.99}) {
    EXPECT_NEAR(density_level(grids.contact, share), 1.0 - share, 0.01) << share;
  }
  EXPECT_TRUE(std::isnan(density_level({0.0, 0.0}, 0.5)));
}

TEST(GridWindow, HoldsBothDensitiesAndIgnoresOneThatVanishes) {
  LikelihoodGrids grids = model();
  // 97 % of a normal distribution lie within 2.65 standard deviations.
  const DensityAxes both = axes_of(grids);
  EXPECT_LT(both.knee_low, 1.0 - 2.5 * 0.2);
  EXPECT_GT(both.knee_high, 2.0 + 2.5 * 0.2);
  EXPECT_LT(both.knee_high, 3.2);
  for (double& value : grids.no_contact) value *= 1e-100;
  EXPECT_EQ(peaks_of(grids).no_contact, 0.0);
  EXPECT_NEAR(peaks_of(grids).contact, 1.0, 1e-12);
  EXPECT_GT(axes_of(grids).knee_low, 1.3);
  for (double& value : grids.contact) value = 0.0;
  for (double& value : grids.no_contact) value = 0.0;
  EXPECT_EQ(axes_of(grids).knee_high, 4.0);
}

TEST(DensityFigure, HasItsTextsAndDrawsModelsWithTorquesOutsideTheAxes) {
  const ScratchFolder folder;
  LikelihoodGrids elsewhere = model();
  for (double& value : elsewhere.no_contact) value *= 1e-100;
  const Figure figure = draw_density_figure(
      {"Torques", {{"one", model()}, {"other", elsewhere}}, "Two runs, seed 1."}, folder / "d");
  const FigureText text = figure_text(read_file(folder / "d.gp"));
  EXPECT_EQ(text.title, "Torques");
  EXPECT_EQ(text.caption, "Two runs, seed 1.");
  EXPECT_THAT(text.alt, ::testing::HasSubstr("other: the peaks are 1 and 0"));
  const std::string drawn = read_file(figure.svg);
  EXPECT_THAT(drawn, ::testing::HasSubstr("all its torques lie<"));
  EXPECT_THAT(drawn, ::testing::HasSubstr(">outside the model"));
  EXPECT_THROW(draw_density_figure({}, folder / "e"), InputError);
}

}  // namespace
}  // namespace touchdown::render
