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

/// A strip of many tiles shows what one of a single tile shows, whole and while it grows.
TEST(StripTiles, ShowTheSamePlots) {
  std::vector<StripRow> rows = {row_of("a", 3), row_of("b", 1)};
  for (std::size_t k = 0; k < 4000; ++k) {
    const double time = 1e-3 * static_cast<double>(k);
    for (std::size_t i = 0; i < 3; ++i) {
      rows[0].curves[i].values[k] =
          static_cast<float>(0.5 + 0.4 * std::sin(3.0 * time + static_cast<double>(i)));
    }
    rows[0].wheels_in_contact.push_back(static_cast<std::uint8_t>(k / 300 % 3));
  }
  std::vector<StripRow> growing = rows;
  for (StripCurve& curve : growing[0].curves) curve.values.resize(2000);
  growing[0].wheels_in_contact.resize(2000);
  SignalStrip one(rows, 1280, 220, {2.0, 0.9, 1});
  SignalStrip many(rows, 1280, 220, {2.0, 0.9, 7});
  SignalStrip grown(growing, 1280, 220, {2.0, 0.9, 7});
  cv::Mat a(220, 1280, CV_8UC3), b = a.clone(), c = a.clone();
  grown.draw(c, 1.9);  // before it grows
  StripRow& row = grown.growing_row(0, 2.0);
  for (std::size_t i = 0; i < 3; ++i) row.curves[i].values = rows[0].curves[i].values;
  row.wheels_in_contact = rows[0].wheels_in_contact;
  for (const double time : {0.3, 2.1, 2.3456, 3.9}) {
    one.draw(a, time);
    many.draw(b, time);
    grown.draw(c, time);
    EXPECT_LT(cv::norm(a, b, cv::NORM_L1) / static_cast<double>(a.total() * 3), 0.05) << time;
    EXPECT_EQ(cv::norm(b, c, cv::NORM_INF), 0.0) << time;
  }
}

}  // namespace
}  // namespace touchdown::render
