#include "apps/viewer/label_lanes.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "apps/viewer/widgets.hpp"
#include "render/gnuplot/frame.hpp"

namespace touchdown::viewer {

namespace {

constexpr unsigned selected = 0x0b3d91;
constexpr unsigned contact_colour = 0x2f8f5b, air_colour = 0xa9cdf0, unknown_colour = 0xc9ccd2;

void draw_hatching(ImDrawList& list, const LaneScale& scale, float top, float bottom) {
  const float height = bottom - top;
  for (float x = scale.left - height; x < scale.left + scale.width; x += 9.0F) {
    list.AddLine({x, bottom}, {x + height, top}, colour_of(0xb3b7bf));
  }
}

void draw_edge(ImDrawList& list, float x, float top, float bottom, bool is_selected) {
  list.AddLine({x, top}, {x, bottom}, colour_of(is_selected ? selected : ink),
               is_selected ? 3.0F : 1.0F);
  if (!is_selected) return;
  for (const float sign : {1.0F, -1.0F}) {  // handles above and below
    const float y = sign > 0.0F ? top : bottom;
    list.AddTriangleFilled({x - 6.0F, y}, {x + 6.0F, y}, {x, y + sign * 7.0F}, colour_of(selected));
  }
}

}  // namespace

float column_of(const LabelEditor& editor, const LaneScale& scale, double time) {
  return std::round(scale.x(static_cast<double>(editor.clock().step_at(time))));
}

void draw_lane(ImDrawList& list, const LabelEditor& editor, std::size_t wheel,
               const LaneScale& scale, float top, float bottom) {
  const auto x = [&](double time) { return column_of(editor, scale, time); };
  const float right = scale.left + scale.width;
  list.PushClipRect({scale.left, top}, {right, bottom}, true);
  list.AddRectFilled({scale.left, top}, {right, bottom}, colour_of(unknown_colour));
  draw_hatching(list, scale, top, bottom);
  for (const logs::ContactInterval& one : editor.labels().intervals) {
    list.AddRectFilled({x(one.start), top}, {x(one.end), bottom},
                       colour_of(one.contact.at(wheel) ? contact_colour : air_colour));
  }
  const bool is_large = bottom - top > 12.0F;  // thin lanes show no edges
  if (is_large) {
    for (const double edge : logs::edges_of(editor.labels(), wheel)) {
      draw_edge(list, x(edge), top, bottom, false);
    }
  }
  if (const auto& selection = editor.selection(); selection && selection->wheel == wheel) {
    const float begin = x(selection->range.begin);
    if (!selection->is_edge()) {
      const float border = is_large ? 3.0F : 1.0F;
      const float end = std::max(x(selection->range.end), begin + 2.0F * border);
      list.AddRect({begin, top}, {end, bottom}, colour_of(selected), 0.0F, 0, border);
    } else if (is_large) {
      draw_edge(list, begin, top, bottom, true);
    }
  }
  list.PopClipRect();
}

void draw_sureness(ImDrawList& list, const LabelEditor& editor, const LaneScale& scale, float top,
                   float bottom) {
  list.PushClipRect({scale.left, top}, {scale.left + scale.width, bottom}, true);
  for (const logs::ContactInterval& one : editor.labels().intervals) {
    const double sure = one.sure.value_or(1.0);
    if (sure >= 1.0) continue;
    const auto doubt = static_cast<float>(std::clamp(4.0 * (1.0 - sure), 0.0, 1.0));
    const float begin = column_of(editor, scale, one.start);
    const float end = std::max(column_of(editor, scale, one.end), begin + 1.0F);
    list.AddRectFilled({begin, top}, {end, top + std::max(1.0F, doubt * (bottom - top))},
                       colour_of(0xe69f00));
  }
  list.PopClipRect();
}

void draw_ruler(ImDrawList& list, const LabelEditor& editor, const LaneScale& scale, float top,
                float bottom) {
  constexpr double least = 90.0;  // px between ticks
  const logs::TimeRange log = editor.clock().range();
  const double mean_period = (log.end - log.begin) / static_cast<double>(std::max<std::size_t>(
                                                         1, editor.clock().step_at(log.end)));
  const double spacing = render::tick_step(least * scale.steps_per_pixel * mean_period, 1.0);
  const int digits = std::clamp(static_cast<int>(std::ceil(-std::log10(spacing) - 1e-9)), 0, 6);
  const auto time_at = [&](double x) {
    const double step = std::max(0.0, std::floor(scale.step(x)));
    return editor.clock().time_of(static_cast<std::size_t>(step));
  };
  const float right = scale.left + scale.width;
  const double first = std::ceil(time_at(scale.left) / spacing) * spacing;
  const double last = time_at(right);
  for (int i = 0; first + i * spacing <= last; ++i) {
    const double time = first + i * spacing;
    const float x = column_of(editor, scale, time);
    const std::string text = fmt::format("{:.{}f}", time, digits);
    if (x + ImGui::CalcTextSize(text.c_str()).x + 4.0F > right) break;
    list.AddLine({x, top + 2.0F}, {x, bottom - 1.0F}, colour_of(grey));
    list.AddText({x + 4.0F, top + 1.0F}, colour_of(grey), text.c_str());
  }
}

}  // namespace touchdown::viewer
