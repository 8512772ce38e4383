#include "render/film/plots.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "core/error.hpp"
#include "core/files.hpp"

namespace touchdown::render {

namespace {

constexpr int oversampling = 2;
constexpr double span_margin = 0.1;  // s: the end of a line must not be visible at the image's edge

const Colour in_contact = rgb(0xcfe8d2);
const Colour unknown = rgb(0xe3e4e8);
const Colour grid = rgb(0xdfe3e6);

cv::Point fixed(double x, double y) {
  return {static_cast<int>(std::lround(x * (1 << subpixel_bits))),
          static_cast<int>(std::lround(y * (1 << subpixel_bits)))};
}

/// A part of the run and its image at twice the size.
struct TimeSpan {
  cv::Mat& image;
  double begin, end;         ///< s
  double pixels_per_second;  ///< of the image

  double x(const StripRow& row, std::size_t k) const {
    return (static_cast<double>(k) * row.period - begin) * pixels_per_second;
  }
  static std::size_t row_at(const StripRow& row, double time, std::size_t size) {
    return static_cast<std::size_t>(std::clamp(time / row.period, 0.0, static_cast<double>(size)));
  }
};

/// Tints the time of true contact of each wheel green, and unknown time grey.
void draw_contact(const TimeSpan& span, const StripRow& row, const PlotArea& area) {
  const auto& contact = row.wheels_in_contact;
  for (std::size_t k = TimeSpan::row_at(row, span.begin, contact.size());
       k < TimeSpan::row_at(row, span.end, contact.size());) {
    std::size_t end = k + 1;
    while (end < contact.size() && contact[end] == contact[k]) ++end;
    const int middle = (area.top + area.bottom) / 2;
    const auto tint = [&](int top, int bottom) {
      cv::rectangle(span.image, fixed(span.x(row, k), top), fixed(span.x(row, end), bottom - 1),
                    contact[k] == unknown_contact ? unknown : in_contact, cv::FILLED, cv::LINE_8,
                    subpixel_bits);
    };
    if ((contact[k] & left_in_contact) != 0) tint(area.top, middle);
    if ((contact[k] & right_in_contact) != 0) tint(middle, area.bottom);
    k = end;
  }
}

void draw_grid(const TimeSpan& span, const StripRow& row, const PlotArea& area) {
  for (const double share : {0.0, 0.5, 1.0}) {
    const float value = row.low + static_cast<float>(share) * (row.high - row.low);
    const auto at = static_cast<int>(std::lround(plot_y(row, area, value)));
    cv::line(span.image, {0, at}, {span.image.cols, at}, grid, oversampling);
  }
}

void draw_curve(const TimeSpan& span, const StripRow& row, const PlotArea& area,
                const StripCurve& curve) {
  const std::size_t size = curve.values.size();
  const std::size_t last = TimeSpan::row_at(row, span.end + span_margin, size);
  const int thickness = oversampling * (curve.emphasis ? 2 : 1);
  std::vector<cv::Point> line;
  const auto flush = [&] {
    if (line.size() > 1) {
      cv::polylines(span.image, line, false, curve.colour, thickness, cv::LINE_AA, subpixel_bits);
    }
    line.clear();
  };
  for (std::size_t k = TimeSpan::row_at(row, span.begin - span_margin, size); k < last; ++k) {
    if (!std::isfinite(curve.values[k])) {
      flush();
      continue;
    }
    line.push_back(fixed(span.x(row, k), plot_y(row, area, curve.values[k])));
  }
  flush();
}

int floor_div(int a, int b) { return a / b - (a % b < 0 ? 1 : 0); }

}  // namespace

std::string font_file() {
  std::string file = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
  if (!is_there(file)) throw Error(file + " is missing: install fonts-dejavu-core");
  return file;
}

TextPen::TextPen() : font_(cv::freetype::createFreeType2()) { font_->loadFontData(font_file(), 0); }

int TextPen::width(const std::string& text, int height) const {
  int baseline = 0;
  return font_->getTextSize(text, height, -1, &baseline).width;
}

int TextPen::write(cv::Mat& image, const std::string& text, int left, int top, int height,
                   const Colour& colour) const {
  font_->putText(image, text, {left, top + height}, height, colour, -1, cv::LINE_AA, true);
  return width(text, height);
}

int TextPen::chip(cv::Mat& image, const std::string& text, int left, int top, int height,
                  const Colour& fill) const {
  const int letters = height / 2;
  const int margin = (2 * height) / 5;
  const int box = width(text, letters) + 2 * margin;
  cv::rectangle(image, cv::Rect(left, top, box, height), fill, cv::FILLED);
  write(image, text, left + margin, top + (height - letters) / 2 - letters / 8, letters,
        rgb(0xffffff));
  return box;
}

float plot_y(const StripRow& row, const PlotArea& area, float value) {
  const float margin = 2.0f;  // keeps a curve at its limit inside
  const float share = std::clamp((value - row.low) / (row.high - row.low), 0.0f, 1.0f);
  const float bottom = static_cast<float>(area.bottom) - margin;
  const float top = static_cast<float>(area.top) + margin;
  return bottom - share * (bottom - top);
}

StripPlots::StripPlots(const std::vector<StripRow>& rows, std::vector<PlotArea> areas, int width,
                       int height, double seconds)
    : rows_(rows), areas_(std::move(areas)), width_(width), height_(height), seconds_(seconds) {}

void StripPlots::copy_window(double from, const cv::Mat& image) {
  const int first = static_cast<int>(std::lround(from * width_ / seconds_));
  for (int number = floor_div(first, width_); number * width_ < first + width_; ++number) {
    const int left = std::max(first, number * width_);
    const int right = std::min(first + width_, (number + 1) * width_);
    tile(number)
        .colRange(left - number * width_, right - number * width_)
        .copyTo(image.colRange(left - first, right - first));
  }
}

const cv::Mat& StripPlots::tile(int number) {
  if (const auto found = tiles_.find(number); found != tiles_.end()) return found->second;
  constexpr std::size_t most = 3;
  if (tiles_.size() > most) tiles_.clear();
  cv::resize(drawn_tile(number), tiles_[number], {width_, height_}, 0, 0, cv::INTER_AREA);
  return tiles_.at(number);
}

cv::Mat StripPlots::drawn_tile(int number) const {
  cv::Mat image(height_ * oversampling, width_ * oversampling, CV_8UC3, strip_paper);
  const TimeSpan span{image, number * seconds_, (number + 1) * seconds_ + span_margin,
                      width_ * oversampling / seconds_};
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const PlotArea area{areas_[i].top * oversampling, areas_[i].bottom * oversampling};
    draw_contact(span, rows_[i], area);
    draw_grid(span, rows_[i], area);
    for (const StripCurve& curve : rows_[i].curves) draw_curve(span, rows_[i], area, curve);
  }
  return image;
}

}  // namespace touchdown::render
