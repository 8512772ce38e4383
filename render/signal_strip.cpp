#include "render/signal_strip.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

namespace touchdown {
namespace {

constexpr double window_seconds = 4.0;
constexpr double present = 0.75;      ///< where in the window now is
constexpr double tile_seconds = 4.0;  ///< a window never needs more than two tiles
constexpr int oversampling = 2;
constexpr int shift = 4;  ///< fractional bits of OpenCV's coordinates

const Colour paper = rgb(0xf7f8fa);
const Colour one_wheel = rgb(0xe6f2e8);
const Colour two_wheels = rgb(0xcfe8d2);
const Colour grid = rgb(0xdfe3e6);
const Colour ink = rgb(0x22262b);

cv::Point fixed(double x, double y) {
  return {static_cast<int>(std::lround(x * (1 << shift))),
          static_cast<int>(std::lround(y * (1 << shift)))};
}

}  // namespace

SignalStrip::SignalStrip(std::vector<StripRow> rows, int width, int height)
    : rows_(std::move(rows)),
      width_(width),
      height_(height),
      left_(std::max(width * 176 / 1280, 60)),
      right_(width - width * 24 / 1280) {
  const int gap = std::max(4, height / 20);
  const int count = std::max<int>(1, static_cast<int>(rows_.size()));
  const int row_height = (height - gap * (count + 1)) / count;
  for (int i = 0; i < count; ++i) {
    const int top = gap + i * (row_height + gap);
    areas_.push_back({top, top + row_height});
  }
  draw_labels();
}

double SignalStrip::pixels_per_second() const { return (right_ - left_) / window_seconds; }

float SignalStrip::y(const StripRow& row, const Area& area, float value) const {
  const float margin = 2.0f;  // keeps a curve at its limit inside
  const float share = std::clamp((value - row.low) / (row.high - row.low), 0.0f, 1.0f);
  const float bottom = static_cast<float>(area.bottom) - margin;
  const float top = static_cast<float>(area.top) + margin;
  return bottom - share * (bottom - top);
}

void SignalStrip::draw_labels() {
  background_ = cv::Mat(height_, width_, CV_8UC3, paper);
  const int letters = std::max(9, height_ * 12 / 220);
  const int left = width_ * 12 / 1280;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Area& area = areas_[i];
    const int line = std::min(letters * 7 / 4, (area.bottom - area.top) / 2);
    int top = area.top + 2;
    pen_.write(background_, rows_[i].title, left, top, letters, ink);
    top += line;
    int x = left;
    for (const double share : {0.0, 1.0}) {
      const float value = rows_[i].low + static_cast<float>(share) * (rows_[i].high - rows_[i].low);
      const std::string tick = fmt::format("{:.2g}", value);
      const auto at = static_cast<int>(y(rows_[i], area, value));
      pen_.write(background_, tick, left_ - 5 - pen_.width(tick, letters - 2),
                 at - (share > 0.0 ? letters / 4 : letters * 3 / 4), letters - 2, rgb(0x5c636e));
    }
    for (auto found = rows_[i].curves.rbegin(); found != rows_[i].curves.rend(); ++found) {
      const StripCurve& curve = *found;  // the first one is drawn last
      if (!curve.emphasis) continue;
      const int dash = letters * 5 / 4;
      const int needed = dash + 4 + pen_.width(curve.label, letters - 1) + letters / 2;
      if (x > left && x + needed > left_ - letters * 2) {
        x = left;
        top += line;
      }
      if (top + letters > area.bottom + 4) break;
      cv::line(background_, {x, top + letters / 2 + 1}, {x + dash, top + letters / 2 + 1},
               curve.colour, 3, cv::LINE_AA);
      pen_.write(background_, curve.label, x + dash + 4, top, letters - 1, curve.colour);
      x += needed;
    }
  }
}

const cv::Mat& SignalStrip::tile(int number) {
  if (const auto found = tiles_.find(number); found != tiles_.end()) return found->second;
  if (tiles_.size() > 3) tiles_.clear();
  const double scale = pixels_per_second() * oversampling;
  cv::Mat image(height_ * oversampling, static_cast<int>(std::lround(scale * tile_seconds)),
                CV_8UC3, paper);
  const double begin = number * tile_seconds;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const StripRow& row = rows_[i];
    const Area area{areas_[i].top * oversampling, areas_[i].bottom * oversampling};
    const auto x_of = [&](double k) { return (k * row.period - begin) * scale; };
    const auto row_at = [&](double time, std::size_t size) {
      return static_cast<std::size_t>(
          std::clamp(time / row.period, 0.0, static_cast<double>(size)));
    };

    const auto& contact = row.wheels_in_contact;
    for (std::size_t k = row_at(begin, contact.size());
         k < row_at(begin + tile_seconds, contact.size());) {
      std::size_t end = k + 1;
      while (end < contact.size() && contact[end] == contact[k]) ++end;
      if (contact[k] > 0) {
        cv::rectangle(image, fixed(x_of(static_cast<double>(k)), area.top),
                      fixed(x_of(static_cast<double>(end)), area.bottom - 1),
                      contact[k] > 1 ? two_wheels : one_wheel, cv::FILLED, cv::LINE_8, shift);
      }
      k = end;
    }
    for (const double share : {0.0, 0.5, 1.0}) {
      const float value = row.low + static_cast<float>(share) * (row.high - row.low);
      const auto at = static_cast<int>(std::lround(y(row, area, value)));
      cv::line(image, {0, at}, {image.cols, at}, grid, oversampling);
    }
    for (const StripCurve& curve : row.curves) {
      const std::size_t size = curve.values.size();
      const std::size_t first = row_at(begin - 0.1, size);
      const std::size_t last = row_at(begin + tile_seconds + 0.1, size);
      const int thickness = oversampling * (curve.emphasis ? 2 : 1);
      std::vector<cv::Point> line;
      const auto flush = [&] {
        if (line.size() > 1) {
          cv::polylines(image, line, false, curve.colour, thickness, cv::LINE_AA, shift);
        }
        line.clear();
      };
      for (std::size_t k = first; k < last; ++k) {
        if (!std::isfinite(curve.values[k])) {
          flush();
          continue;
        }
        line.push_back(fixed(x_of(static_cast<double>(k)), y(row, area, curve.values[k])));
      }
      flush();
    }
  }
  return tiles_.emplace(number, std::move(image)).first->second;
}

/// The plots from time `from` on, at twice the size.
cv::Mat SignalStrip::window(double from) {
  const int width = (right_ - left_) * oversampling;
  cv::Mat image(height_ * oversampling, width, CV_8UC3, paper);
  const double scale = pixels_per_second() * oversampling;
  const int begin = static_cast<int>(std::lround(from * scale));
  const int tile_width = static_cast<int>(std::lround(scale * tile_seconds));
  const auto floor_div = [](int a, int b) { return a / b - (a % b < 0 ? 1 : 0); };
  for (int number = floor_div(begin, tile_width); number * tile_width < begin + width; ++number) {
    const cv::Mat& source = tile(number);
    const int left = std::max(begin, number * tile_width);
    const int right = std::min(begin + width, (number + 1) * tile_width);
    source.colRange(left - number * tile_width, right - number * tile_width)
        .copyTo(image.colRange(left - begin, right - begin));
  }
  return image;
}

void SignalStrip::draw(cv::Mat image, double time) {
  background_.copyTo(image);
  cv::Mat plots = image.colRange(left_, right_);
  cv::resize(window(time - present * window_seconds), plots, plots.size(), 0, 0, cv::INTER_AREA);
  const int now = static_cast<int>(std::lround(present * plots.cols));
  cv::Mat future = plots.colRange(now, plots.cols);
  cv::addWeighted(future, 0.4, cv::Mat(future.size(), CV_8UC3, paper), 0.6, 0.0, future);
  cv::line(plots, {now, areas_.front().top - 2}, {now, areas_.back().bottom + 2}, ink, 1);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    for (const StripCurve& curve : rows_[i].curves) {
      const double k = time / rows_[i].period;
      if (!curve.emphasis || k < 0 || k >= static_cast<double>(curve.values.size())) continue;
      const float value = curve.values[static_cast<std::size_t>(k)];
      if (!std::isfinite(value)) continue;
      cv::circle(plots, fixed(now, y(rows_[i], areas_[i], value)), 4 << shift, curve.colour,
                 cv::FILLED, cv::LINE_AA, shift);
    }
  }
}

}  // namespace touchdown
