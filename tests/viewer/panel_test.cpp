#include "apps/viewer/panel.hpp"

#include <gtest/gtest.h>

namespace touchdown::viewer {
namespace {

/// The row and the column of the slider's handle in a drawn panel: the middle of its pixels.
struct Place {
  double x = 0.0, y = 0.0;
  int pixels = 0;
};
Place handle_in(const cv::Mat& image) {
  Place place;
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const auto& pixel = image.at<cv::Vec3b>(y, x);
      if (pixel != cv::Vec3b(0xb2, 0x72, 0x00)) continue;  // blue, green, red
      place.x += x;
      place.y += y;
      ++place.pixels;
    }
  }
  place.x /= std::max(1, place.pixels);
  place.y /= std::max(1, place.pixels);
  return place;
}

std::vector<PanelLine> lines_with(double share) {
  return {{.text = "sensors", .heading = true},
          {.text = "profile", .value = "ideal"},
          {.text = "torque noise", .value = "1 N·m", .slider = PanelSlider{2, share}},
          {.text = "more"}};
}

TEST(Panel, ASliderIsWhereTheMouseSetsIt) {
  const render::TextPen pen;
  for (const auto& [width, height] : {std::pair{300, 200}, {220, 90}, {420, 900}}) {
    const Place drawn = handle_in(panel(pen, lines_with(0.0), width, height));
    ASSERT_GT(drawn.pixels, 20);
    const auto slider = slider_at(lines_with(0.0), width, height, drawn.x, drawn.y);
    ASSERT_TRUE(slider) << width << "x" << height;
    EXPECT_EQ(slider->number, 2);
    EXPECT_NEAR(slider->share, 0.0, 0.02);
    const int above = static_cast<int>(drawn.y) - 30;
    EXPECT_FALSE(slider_at(lines_with(0.0), width, height, drawn.x, above));
    EXPECT_FALSE(slider_at(lines_with(0.0), width, height, drawn.x, height + 100));
    EXPECT_FALSE(slider_at(lines_with(0.0), width, height, drawn.x, -5));
  }
  EXPECT_EQ(slider_share(300, -100), 0.0);
  EXPECT_EQ(slider_share(300, 150), 0.5);
  EXPECT_EQ(slider_share(300, 1000), 1.0);
}

TEST(Panel, ASliderIsAsLongAsItsShare) {
  const render::TextPen pen;
  int before = handle_in(panel(pen, lines_with(0.0), 300, 200)).pixels;
  for (const double share : {0.25, 0.5, 1.0}) {
    const int now = handle_in(panel(pen, lines_with(share), 300, 200)).pixels;
    EXPECT_GT(now, before + 100);
    before = now;
  }
  EXPECT_EQ(handle_in(panel(pen, lines_with(2.0), 300, 200)).pixels, before);
}

}  // namespace
}  // namespace touchdown::viewer
