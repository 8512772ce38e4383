#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "render/film/strip.hpp"
#include "render/palette.hpp"

namespace touchdown::render {
namespace {

const std::vector<std::string> titles = {
    "Load filter",          "Bayes filter (robust)", "Upkie's observer", "Bayes filter (reference)",
    "Bayes filter (paper)", "Measurement only",      "Free fall",        "Recurrent network"};

/// A row with a constant curve of each of the first `curves` titles.
StripRow row_of(const std::string& title, std::size_t curves) {
  StripRow row{.title = title, .curves = {}, .wheels_in_contact = {}};
  for (std::size_t i = curves; i-- > 0;) {
    row.curves.push_back({titles[i], rgb(line_colour(i + 1)), std::vector<float>(4000, 0.5F)});
  }
  return row;
}

/// Pixels of this colour, apart from anti-aliased ones, in a part of the image.
int pixels_of(const cv::Mat& image, const Colour& colour) {
  cv::Mat same;
  cv::inRange(image, colour, colour, same);
  return cv::countNonZero(same);
}

/// The strip at a time without curves, so that only names have their colours.
cv::Mat names_of(const std::vector<StripRow>& rows, int width, int height) {
  cv::Mat image(height, width, CV_8UC3);
  SignalStrip(rows, width, height).draw(image, 100.0);
  return image;
}

struct Size {
  int width, height;
};

TEST(Legend, NamesEveryCurveInItsColour) {
  for (const Size size : {Size{1280, 220}, Size{1920, 330}, Size{1000, 152}, Size{960, 225},
                          Size{640, 150}, Size{480, 150}}) {
    for (std::size_t curves = 1; curves <= titles.size(); ++curves) {
      const cv::Mat image = names_of({row_of("contact probability", curves),
                                      row_of("takeoff / landing", 0), row_of("torque (N·m)", 0)},
                                     size.width, size.height);
      for (std::size_t i = 0; i < curves; ++i) {
        EXPECT_GT(pixels_of(image, rgb(line_colour(i + 1))), 15)
            << titles[i] << " of " << curves << ", " << size.width << "x" << size.height;
      }
    }
  }
}

/// Two runs have the same estimators: their names are there once.
TEST(Legend, NamesTheSameCurveOnce) {
  const cv::Mat once =
      names_of({row_of("P(contact), MuJoCo", 4), row_of("P(contact), Bullet", 0)}, 960, 225);
  const cv::Mat twice =
      names_of({row_of("P(contact), MuJoCo", 4), row_of("P(contact), Bullet", 4)}, 960, 225);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(pixels_of(once, rgb(line_colour(i + 1))), pixels_of(twice, rgb(line_colour(i + 1))));
  }
}

}  // namespace
}  // namespace touchdown::render
