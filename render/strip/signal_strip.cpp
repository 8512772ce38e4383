#include "render/strip/signal_strip.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

namespace touchdown::render {
namespace {

constexpr int wide = 1000;  ///< from this width on, names fit beside the plots

}  // namespace

SignalStrip::SignalStrip(std::vector<StripRow> rows, int width, int height,
                         const StripWindow& window)
    : rows_(std::move(rows)),
      window_(window),
      width_(width),
      height_(height),
      narrow_(width < wide),
      letters_(narrow_ ? std::clamp(height * 11 / 150, 8, 13) : std::max(9, height * 12 / 220)),
      left_(narrow_ ? 3 * letters_ : std::max(width * 176 / 1280, 60)),
      right_(narrow_ ? width - letters_ : width - width * 24 / 1280) {
  place_rows(narrow_ ? letters_ + letters_ / 2 : 0);
  background_ = cv::Mat(height_, width_, CV_8UC3, strip_paper);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    draw_ticks(i);
    if (narrow_) {
      draw_names_above(i);
    } else {
      draw_names_beside(i);
    }
  }
  const int plot_width = right_ - left_;
  const int now = static_cast<int>(std::lround(window_.present * plot_width));
  fog_ = cv::Mat(height_, plot_width - now, CV_8UC3, strip_paper);
  plots_ = std::make_unique<StripPlots>(rows_, areas_, plot_width, height_, window_.seconds);
}

void SignalStrip::place_rows(int header) {
  const int gap = std::max(4, height_ / 20);
  const int count = std::max<int>(1, static_cast<int>(rows_.size()));
  const int row_height = (height_ - gap * (count + 1)) / count;
  for (int i = 0; i < count; ++i) {
    const int top = gap + i * (row_height + gap);
    areas_.push_back({top + std::min(header, row_height / 2), top + row_height});
  }
}

void SignalStrip::draw_ticks(std::size_t i) {
  const int letters = narrow_ ? letters_ - 1 : letters_ - 2;
  for (const double share : {0.0, 1.0}) {
    const float value = rows_[i].low + static_cast<float>(share) * (rows_[i].high - rows_[i].low);
    const std::string tick = fmt::format("{:.2g}", value);
    const auto at = static_cast<int>(plot_y(rows_[i], areas_[i], value));
    pen_.write(background_, tick, left_ - 5 - pen_.width(tick, letters),
               at - (share > 0.0 ? letters_ / 4 : letters_ * 3 / 4), letters, rgb(0x5c636e));
  }
}

int SignalStrip::legend_width(const StripCurve& curve) const {
  return letters_ * 5 / 4 + 4 + pen_.width(curve.label, letters_ - 1) + letters_ / 2;
}

void SignalStrip::draw_legend(const StripCurve& curve, int x, int top) {
  const int dash = letters_ * 5 / 4;
  const int middle = top + letters_ / 2 + 1;
  cv::line(background_, {x, middle}, {x + dash, middle}, curve.colour, 3, cv::LINE_AA);
  pen_.write(background_, curve.label, x + dash + 4, top, letters_ - 1, curve.colour);
}

void SignalStrip::draw_names_beside(std::size_t i) {
  const PlotArea& area = areas_[i];
  const int left = width_ * 12 / 1280;
  const int line = std::min(letters_ * 7 / 4, (area.bottom - area.top) / 2);
  int top = area.top + 2;
  pen_.write(background_, rows_[i].title, left, top, letters_, strip_ink);
  top += line;
  int x = left;
  // The first curve of the legend is drawn last.
  for (auto curve = rows_[i].curves.rbegin(); curve != rows_[i].curves.rend(); ++curve) {
    if (!curve->emphasis || curve->label.empty()) continue;
    if (x > left && x + legend_width(*curve) > left_ - letters_ * 2) {
      x = left;
      top += line;
    }
    if (top + letters_ > area.bottom + 4) break;
    draw_legend(*curve, x, top);
    x += legend_width(*curve);
  }
}

void SignalStrip::draw_names_above(std::size_t i) {
  const int top = areas_[i].top - letters_ - letters_ / 2;
  int x = left_;
  x += pen_.write(background_, rows_[i].title, x, top, letters_, strip_ink) + letters_;
  for (auto curve = rows_[i].curves.rbegin(); curve != rows_[i].curves.rend(); ++curve) {
    if (!curve->emphasis || curve->label.empty()) continue;
    if (x + legend_width(*curve) > right_) break;
    draw_legend(*curve, x, top);
    x += legend_width(*curve) + letters_ / 2;
  }
}

StripRow& SignalStrip::growing_row(std::size_t i, double time) {
  plots_->redraw_from(time);
  return rows_[i];
}

void SignalStrip::draw(cv::Mat image, double time) {
  background_.copyTo(image);
  cv::Mat plots = image.colRange(left_, right_);
  plots_->copy_window(time - window_.present * window_.seconds, plots);
  if (narrow_) {  // names stand on the plots' paper, above them
    for (const PlotArea& area : areas_) {
      const int top = std::max(0, area.top - letters_ - letters_ / 2);
      background_.rowRange(top, area.top).copyTo(image.rowRange(top, area.top));
    }
  }
  const int now = plots.cols - fog_.cols;
  for (const PlotArea& area : areas_) {
    cv::Mat future = plots(cv::Rect(now, area.top, fog_.cols, area.bottom - area.top));
    cv::addWeighted(future, 0.4, fog_.rowRange(area.top, area.bottom), 0.6, 0.0, future);
  }
  cv::line(plots, {now, areas_.front().top - 2}, {now, areas_.back().bottom + 2}, strip_ink, 1);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    for (const StripCurve& curve : rows_[i].curves) {
      const double k = time / rows_[i].period;
      if (!curve.emphasis || k < 0 || k >= static_cast<double>(curve.values.size())) continue;
      const float value = curve.values[static_cast<std::size_t>(k)];
      if (!std::isfinite(value)) continue;
      const auto y =
          static_cast<int>(std::lround(plot_y(rows_[i], areas_[i], value) * (1 << subpixel_bits)));
      cv::circle(plots, {now << subpixel_bits, y}, 4 << subpixel_bits, curve.colour, cv::FILLED,
                 cv::LINE_AA, subpixel_bits);
    }
  }
}

}  // namespace touchdown::render
