#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "apps/viewer/label_editor.hpp"

namespace touchdown::viewer {

namespace {

const render::Colour selected = render::rgb(0x0b3d91);
const render::Colour edge_colour = render::rgb(0x22262b);
const render::Colour quiet = render::rgb(0x5c636e);

/// The columns of a range of time, cut to the lane; empty beyond it.
cv::Rect columns(const LabelEditor& editor, const LaneScale& scale, const logs::TimeRange& range,
                 int top, int bottom) {
  const auto x = [&](double time) {
    return std::clamp(column_of(editor, scale, time), scale.left, scale.left + scale.width);
  };
  return {x(range.begin), top, x(range.end) - x(range.begin), bottom - top};
}

void draw_hatching(cv::Mat lane) {
  for (int x = -lane.rows; x < lane.cols; x += 9) {
    cv::line(lane, {x, lane.rows}, {x + lane.rows, 0}, render::rgb(0xb3b7bf), 1, cv::LINE_AA);
  }
}

void draw_edge(cv::Mat& image, const LabelEditor& editor, const LaneScale& scale, double edge,
               int top, int bottom, bool is_selected) {
  const int at = column_of(editor, scale, edge);
  if (at < scale.left || at > scale.left + scale.width) return;
  cv::line(image, {at, top}, {at, bottom - 1}, is_selected ? selected : edge_colour,
           is_selected ? 3 : 1);
  if (!is_selected) return;
  for (const int sign : {1, -1}) {  // handles above and below
    const int y = sign > 0 ? top : bottom - 1;
    const std::vector<cv::Point> handle = {{at - 6, y}, {at + 6, y}, {at, y + sign * 7}};
    cv::fillConvexPoly(image, handle, selected, cv::LINE_AA);
  }
}

}  // namespace

int column_of(const LabelEditor& editor, const LaneScale& scale, double time) {
  return static_cast<int>(std::lround(scale.x(static_cast<double>(editor.clock().step_at(time)))));
}

void draw_lane(cv::Mat& image, const LabelEditor& editor, std::size_t wheel, const LaneScale& scale,
               int top, int bottom) {
  const cv::Rect lane(scale.left, top, scale.width, bottom - top);
  image(lane).setTo(render::rgb(unknown_colour));
  draw_hatching(image(lane));
  for (const logs::ContactInterval& one : editor.labels().intervals) {
    const cv::Rect area = columns(editor, scale, {one.start, one.end}, top, bottom);
    if (area.width <= 0) continue;
    cv::rectangle(image, area, render::rgb(one.contact.at(wheel) ? contact_colour : air_colour),
                  cv::FILLED);
  }
  const bool is_large = lane.height > 12;  // thin lanes show no edges
  const auto& selection = editor.selection();
  const bool is_here = selection && selection->wheel == wheel;
  if (is_large) {
    for (const double edge : logs::edges_of(editor.labels(), wheel)) {
      draw_edge(image, editor, scale, edge, top, bottom, false);
    }
  }
  if (!is_here) return;
  if (selection->is_edge()) {
    if (is_large) draw_edge(image, editor, scale, selection->range.begin, top, bottom, true);
    return;
  }
  cv::Rect area = columns(editor, scale, selection->range, top, bottom);
  const int border = is_large ? 3 : 1;
  area.width = std::max(area.width, 2 * border);
  cv::rectangle(image, area & cv::Rect(0, 0, image.cols, image.rows), selected, border);
}

void draw_sureness(cv::Mat& image, const LabelEditor& editor, const LaneScale& scale, int top,
                   int bottom) {
  for (const logs::ContactInterval& one : editor.labels().intervals) {
    const double sure = one.sure.value_or(1.0);
    if (sure >= 1.0) continue;
    cv::Rect area = columns(editor, scale, {one.start, one.end}, top, bottom);
    if (area.x >= scale.left + scale.width || area.x + area.width < scale.left) continue;
    area.width = std::max(area.width, 1);
    const double doubt = std::clamp(4.0 * (1.0 - sure), 0.0, 1.0);
    area.height = std::max(1, static_cast<int>(std::lround(doubt * area.height)));
    cv::rectangle(image, area & cv::Rect(0, 0, image.cols, image.rows), render::rgb(0xe69f00),
                  cv::FILLED);
  }
}

void draw_ruler(cv::Mat& image, const render::TextPen& pen, const LabelEditor& editor,
                const LaneScale& scale, int top, int bottom) {
  constexpr double least = 90.0;  // px between ticks
  const logs::TimeRange log = editor.clock().range();
  const double mean_period = (log.end - log.begin) / static_cast<double>(std::max<std::size_t>(
                                                         1, editor.clock().step_at(log.end)));
  const double wanted = least * scale.steps_per_pixel * mean_period;
  const double power = std::pow(10.0, std::floor(std::log10(wanted)));
  double spacing = 10.0 * power;
  for (const double factor : {5.0, 2.0, 1.0}) {
    if (factor * power >= wanted) spacing = factor * power;
  }
  const int digits = std::clamp(static_cast<int>(std::ceil(-std::log10(spacing) - 1e-9)), 0, 6);
  const int letters = bottom - top - 6;
  const auto time_at = [&](double x) {
    const double step = std::max(0.0, std::floor(scale.step(x)));
    return editor.clock().time_of(static_cast<std::size_t>(step));
  };
  const double first = std::ceil(time_at(scale.left) / spacing) * spacing;
  const double last = time_at(scale.left + scale.width);
  for (int i = 0; first + i * spacing <= last; ++i) {
    const double time = first + i * spacing;
    const int x = column_of(editor, scale, time);
    const std::string text = fmt::format("{:.{}f}", time, digits);
    if (x + pen.width(text, letters) + 4 > scale.left + scale.width) break;
    cv::line(image, {x, top + 2}, {x, bottom - 1}, quiet, 1);
    pen.write(image, text, x + 4, top + 1, letters, quiet);
  }
}

}  // namespace touchdown::viewer
