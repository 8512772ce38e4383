#include "apps/viewer/panel.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "render/palette.hpp"

namespace touchdown::viewer {

namespace {

constexpr render::StripWindow plot_window = {.seconds = 6.0, .present = 0.98, .tiles = 8};
constexpr float acceleration_range = 20.0F;  // m/s²

const render::Colour in_contact = render::rgb(0x2f8f5b);
const render::Colour in_air = render::rgb(0xffffff);
const render::Colour wrong_border = render::rgb(0xd0122f);
const render::Colour quiet = render::rgb(0x5c636e);
const render::Colour track = render::rgb(0xd5dade);
const render::Colour handle = render::rgb(0x0072b2);

void draw_badges(cv::Mat& image, const render::TextPen& pen, const ContactBadges& badges, int left,
                 int top, int size) {
  for (std::size_t wheel = 0; wheel < 2; ++wheel) {
    const cv::Rect box(left + static_cast<int>(wheel) * (size + size / 3), top, size, size);
    const bool contact = badges.contact[wheel];
    cv::rectangle(image, box, contact ? in_contact : in_air, cv::FILLED);
    cv::rectangle(image, box, badges.wrong[wheel] ? wrong_border : quiet,
                  badges.wrong[wheel] ? 3 : 1);
    const int letters = size * 6 / 10;
    const char* const name = wheel == 0 ? "L" : "R";
    pen.write(image, name, box.x + (size - pen.width(name, letters)) / 2,
              top + (size - letters) / 2 - 1, letters, contact ? in_air : quiet);
  }
}

constexpr int side_margin = 12;  // px, left and right
constexpr int first_top = 6;     // px
constexpr int smallest_letters = 8;

int line_height(const std::vector<PanelLine>& lines, int height) {
  const int count = static_cast<int>(lines.size());
  return std::clamp((height - 8) / std::max(1, count), 12, 26);
}

void draw_slider(cv::Mat& image, double share, int bottom) {
  const int length = image.cols - 2 * side_margin;
  const int at = side_margin + static_cast<int>(std::lround(std::clamp(share, 0.0, 1.0) * length));
  cv::rectangle(image, cv::Rect(side_margin, bottom - 4, length, 3), track, cv::FILLED);
  cv::rectangle(image, cv::Rect(side_margin, bottom - 4, at - side_margin, 3), handle, cv::FILLED);
  cv::rectangle(image, cv::Rect(at - 3, bottom - 6, 7, 7), handle, cv::FILLED);
}

}  // namespace

unsigned estimator_colour(std::size_t i) { return render::line_colour(i + 1); }

LivePlots::LivePlots(std::size_t estimators, double period, double weight) : period_(period) {
  // As far as usual torques reach. Larger ones widen it.
  const auto torque_range = static_cast<float>(std::max(1.0, 0.06 * weight));  // N·m
  for (const char* const title : {"P(contact), left", "P(contact), right"}) {
    render::StripRow row{.title = title, .curves = {}, .wheels_in_contact = {}, .period = period};
    for (std::size_t i = estimators; i-- > 0;) {                         // the first one on top
      row.curves.push_back({"", render::rgb(estimator_colour(i)), {}});  // named in the panel
    }
    rows_.push_back(std::move(row));
  }
  rows_.push_back(
      {.title = "torque (N·m)",
       .low = -torque_range,
       .high = torque_range,
       .curves = {{"wheel", render::rgb(0x009e73), {}}, {"knee", render::rgb(0xb0304f), {}}},
       .wheels_in_contact = {},
       .period = period});
  rows_.push_back({.title = "acceleration (m/s²)",
                   .low = -acceleration_range,
                   .high = acceleration_range,
                   .curves = {{"vertical", render::rgb(0x7b3fb0), {}}},
                   .wheels_in_contact = {},
                   .period = period});
}

double LivePlots::end() const {
  return period_ * static_cast<double>(std::max<std::size_t>(count_, 1) - 1);
}

void LivePlots::append(const std::vector<LiveSample>& samples) {
  if (samples.empty()) return;
  const auto row = [&](std::size_t i) -> render::StripRow& {
    return strip_ ? strip_->growing_row(i, end()) : rows_[i];
  };
  for (const LiveSample& sample : samples) {
    for (std::size_t wheel = 0; wheel < 2; ++wheel) {
      render::StripRow& beliefs = row(wheel);
      beliefs.wheels_in_contact.push_back(sample.contact[wheel] ? render::both_in_contact
                                                                : std::uint8_t{0});
      for (std::size_t i = 0; i < sample.p_contact.size(); ++i) {
        beliefs.curves[beliefs.curves.size() - 1 - i].values.push_back(sample.p_contact[i][wheel]);
      }
    }
    row(2).curves[0].values.push_back(sample.wheel_torque);
    row(2).curves[1].values.push_back(sample.knee_torque);
    row(3).curves[0].values.push_back(sample.acceleration);
    ++count_;
    widen(std::max(std::abs(sample.wheel_torque), std::abs(sample.knee_torque)));
  }
}

void LivePlots::widen(float torque) {
  const float high = strip_ ? strip_->rows()[2].high : rows_[2].high;
  if (!(torque > high) || !std::isfinite(torque)) return;
  if (strip_) rows_ = strip_->rows();
  strip_.reset();
  rows_[2].high = 1.25F * torque;
  rows_[2].low = -rows_[2].high;
}

const cv::Mat& LivePlots::draw(int width, int height) {
  if (!strip_ || image_.cols != width || image_.rows != height) {
    if (strip_) rows_ = strip_->rows();
    strip_ = std::make_unique<render::SignalStrip>(std::move(rows_), width, height, plot_window);
    image_.create(height, width, CV_8UC3);
  }
  strip_->draw(image_, end());
  return image_;
}

double slider_share(int width, double x) {
  return std::clamp((x - side_margin) / std::max(1, width - 2 * side_margin), 0.0, 1.0);
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
    int letters = line * (one.heading ? 54 : 50) / 100;
    const int badges = one.badges ? line * 2 : 0;
    const auto needed = [&] {
      return pen.width(one.text, letters) + pen.width(one.value, letters) + badges;
    };
    while (letters > smallest_letters && needed() > width - 5 * side_margin / 2) --letters;
    if (one.heading && top > first_top) {
      cv::line(image, {side_margin, top}, {width - side_margin, top}, render::rgb(0xdfe3e6));
    }
    const int text_top = top + (line - letters) / 2 - (one.slider ? line / 10 : 0);
    pen.write(image, one.text, side_margin, text_top, letters, one.heading ? quiet : one.colour);
    int right = width - side_margin;
    if (!one.value.empty()) {
      right -= pen.width(one.value, letters);
      pen.write(image, one.value, right, text_top, letters, one.heading ? quiet : one.colour);
      right -= side_margin / 2;
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
