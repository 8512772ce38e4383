#include "viewer/screen/panel.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace touchdown::viewer {

namespace {

const render::Colour in_contact = render::rgb(0x2f8f5b);
const render::Colour in_air = render::rgb(0xffffff);
const render::Colour wrong = render::rgb(0xd0122f);
const render::Colour quiet = render::rgb(0x5c636e);
const render::Colour track = render::rgb(0xd5dade);
const render::Colour handle = render::rgb(0x0072b2);

void draw_badges(cv::Mat& image, const render::TextPen& pen, const ContactBadges& badges, int left,
                 int top, int size) {
  for (std::size_t wheel = 0; wheel < 2; ++wheel) {
    const cv::Rect box(left + static_cast<int>(wheel) * (size + size / 3), top, size, size);
    const bool contact = badges.contact[wheel];
    cv::rectangle(image, box, contact ? in_contact : in_air, cv::FILLED);
    cv::rectangle(image, box, badges.wrong[wheel] ? wrong : quiet, badges.wrong[wheel] ? 3 : 1);
    const int letters = size * 6 / 10;
    const char* const name = wheel == 0 ? "L" : "R";
    pen.write(image, name, box.x + (size - pen.width(name, letters)) / 2,
              top + (size - letters) / 2 - 1, letters, contact ? in_air : quiet);
  }
}

constexpr int margin = 12;    // px, left and right
constexpr int first_top = 6;  // px

int line_height(const std::vector<PanelLine>& lines, int height) {
  const int count = static_cast<int>(lines.size());
  return std::clamp((height - 8) / std::max(1, count), 12, 26);
}

void draw_slider(cv::Mat& image, double share, int bottom) {
  const int length = image.cols - 2 * margin;
  const int at = margin + static_cast<int>(std::lround(std::clamp(share, 0.0, 1.0) * length));
  cv::rectangle(image, cv::Rect(margin, bottom - 4, length, 3), track, cv::FILLED);
  cv::rectangle(image, cv::Rect(margin, bottom - 4, at - margin, 3), handle, cv::FILLED);
  cv::rectangle(image, cv::Rect(at - 3, bottom - 6, 7, 7), handle, cv::FILLED);
}

}  // namespace

double slider_share(int width, double x) {
  return std::clamp((x - margin) / std::max(1, width - 2 * margin), 0.0, 1.0);
}

std::optional<PanelSlider> slider_at(const std::vector<PanelLine>& lines, int width, int height,
                                     double x, double y) {
  const double line = std::floor((y - first_top) / line_height(lines, height));
  if (line < 0.0 || line >= static_cast<double>(lines.size())) return std::nullopt;
  std::optional<PanelSlider> slider = lines[static_cast<std::size_t>(line)].slider;
  if (slider) slider->share = slider_share(width, x);
  return slider;
}

cv::Mat panel(const render::TextPen& pen, const std::vector<PanelLine>& lines, int width,
              int height) {
  cv::Mat image(height, width, CV_8UC3, render::strip_paper);
  const int line = line_height(lines, height);
  int top = first_top;
  for (const PanelLine& one : lines) {
    const int letters = line * (one.heading ? 54 : 50) / 100;
    if (one.heading && top > first_top) {
      cv::line(image, {margin, top}, {width - margin, top}, render::rgb(0xdfe3e6));
    }
    const int text_top = top + (line - letters) / 2 - (one.slider ? line / 10 : 0);
    pen.write(image, one.text, margin, text_top, letters, one.heading ? quiet : one.colour);
    int right = width - margin;
    if (!one.value.empty()) {
      right -= pen.width(one.value, letters);
      pen.write(image, one.value, right, text_top, letters, one.heading ? quiet : one.colour);
      right -= margin / 2;
    }
    if (one.badges) {
      const int size = line * 8 / 10;
      draw_badges(image, pen, *one.badges, right - 2 * size - size / 3, top + (line - size) / 2,
                  size);
    }
    if (one.slider) draw_slider(image, one.slider->share, top + line);
    top += line;
  }
  return image;
}

}  // namespace touchdown::viewer
