#include "apps/viewer/curves.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "apps/viewer/widgets.hpp"

namespace touchdown::viewer {

namespace {

/// A row's plot in the window.
struct Plot {
  ImDrawList& list;
  const render::StripRow& row;
  const LaneScale& scale;
  float top, bottom;

  float right() const { return scale.left + scale.width; }
  float y(float value) const {
    return render::plot_y(row, {static_cast<int>(top), static_cast<int>(bottom)}, value);
  }
  /// The visible steps [first, second) of so many.
  std::pair<std::size_t, std::size_t> steps(std::size_t count) const {
    const auto within = [&](double step) {
      return static_cast<std::size_t>(std::clamp(step, 0.0, static_cast<double>(count)));
    };
    return {within(scale.first - 1.0), within(scale.step(right()) + 2.0)};
  }
};

/// Tints the time of true contact of each wheel green, and unknown time grey.
void draw_contact(const Plot& plot) {
  const auto& contact = plot.row.wheels_in_contact;
  const float middle = 0.5F * (plot.top + plot.bottom);
  const auto [first, last] = plot.steps(contact.size());
  for (std::size_t k = first; k < last;) {
    std::size_t end = k + 1;
    while (end < last && contact[end] == contact[k]) ++end;
    const bool is_known = contact[k] != render::unknown_contact;
    const ImU32 tint = colour_of(is_known ? 0xcfe8d2 : 0xe3e4e8);
    const float from = plot.scale.x(static_cast<double>(k));
    const float to = plot.scale.x(static_cast<double>(end));
    if ((contact[k] & render::left_in_contact) != 0) {
      plot.list.AddRectFilled({from, plot.top}, {to, middle}, tint);
    }
    if ((contact[k] & render::right_in_contact) != 0) {
      plot.list.AddRectFilled({from, middle}, {to, plot.bottom}, tint);
    }
    k = end;
  }
}

/// Draws lines between the steps. Of steps that share a column of pixels, the extremes suffice.
void draw_curve(const Plot& plot, const render::StripCurve& curve) {
  const ImU32 colour = colour_of(curve.colour);
  const float thickness = curve.emphasis ? 2.0F : 1.0F;
  const auto [first, last] = plot.steps(curve.values.size());
  const auto group = static_cast<std::size_t>(std::max(1.0, plot.scale.steps_per_pixel));
  std::optional<ImVec2> before;
  for (std::size_t k = first - first % group; k < last; k += group) {
    float low = curve.values[k];
    float high = low;
    for (std::size_t i = k + 1; i < std::min(k + group, last); ++i) {
      low = std::min(low, curve.values[i]);
      high = std::max(high, curve.values[i]);
    }
    if (!std::isfinite(low) || !std::isfinite(high)) {
      before.reset();
      continue;
    }
    const float x = plot.scale.x(static_cast<double>(k));
    const ImVec2 top(x, plot.y(high));
    const ImVec2 bottom(x, plot.y(low));
    if (before) plot.list.AddLine(*before, top, colour, thickness);
    if (high > low) plot.list.AddLine(top, bottom, colour, thickness);
    before = bottom;
  }
}

void draw_dots(const Plot& plot, double present) {
  for (const render::StripCurve& curve : plot.row.curves) {
    if (!curve.emphasis || present >= static_cast<double>(curve.values.size())) continue;
    const float value = curve.values[static_cast<std::size_t>(std::max(0.0, present))];
    if (!std::isfinite(value)) continue;
    plot.list.AddCircleFilled({plot.scale.x(present), plot.y(value)}, 4.0F,
                              colour_of(curve.colour));
  }
}

/// Title, legend and range, left of the plot.
void draw_names(const Plot& plot, float left) {
  const float right = plot.scale.left - 36.0F;  // left of the range
  ImGui::PushClipRect({left, plot.top - 2.0F}, {plot.scale.left, plot.bottom + 4.0F}, true);
  ImGui::SetCursorScreenPos({left, plot.top});
  ImGui::BeginGroup();
  ImGui::PushTextWrapPos(right - ImGui::GetWindowPos().x);
  ImGui::TextUnformatted(plot.row.title.c_str());
  ImGui::PopTextWrapPos();
  float end = right;  // of the last name
  // The first curve of the legend is drawn last.
  for (auto curve = plot.row.curves.rbegin(); curve != plot.row.curves.rend(); ++curve) {
    if (!curve->emphasis || curve->label.empty()) continue;
    if (end + ImGui::CalcTextSize(curve->label.c_str()).x + 8.0F < right) ImGui::SameLine();
    ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(colour_of(curve->colour)), "%s",
                       curve->label.c_str());
    end = ImGui::GetItemRectMax().x;
  }
  ImGui::EndGroup();
  for (const float value : {plot.row.low, plot.row.high}) {
    const std::string tick = fmt::format("{:.2g}", value);
    const ImVec2 size = ImGui::CalcTextSize(tick.c_str());
    const float share = value == plot.row.low ? 0.8F : 0.2F;
    plot.list.AddText({plot.scale.left - 5.0F - size.x, plot.y(value) - share * size.y},
                      colour_of(grey), tick.c_str());
  }
  ImGui::PopClipRect();
}

}  // namespace

LaneScale scale_of(const Area& area, double first, double steps) {
  const float left = std::floor(std::max(150.0F, area.width * 176.0F / 1280.0F));
  const float width = std::floor(area.width * 1256.0F / 1280.0F) - left;
  return {first, steps / width, area.left + left, width};
}

void draw_curves(const std::vector<render::StripRow>& rows, const LaneScale& scale,
                 const Area& area, double present, bool fades) {
  constexpr float gap = 10.0F;  // px between plots
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float height = (area.height - gap) / static_cast<float>(rows.size()) - gap;
  const float now = scale.x(present);
  float top = area.top + gap;
  for (const render::StripRow& row : rows) {
    const Plot plot{list, row, scale, top, top + height};
    draw_names(plot, area.left + 12.0F);
    list.PushClipRect({scale.left, plot.top}, {plot.right(), plot.bottom}, true);
    draw_contact(plot);
    for (const float value : {row.low, 0.5F * (row.low + row.high), row.high}) {
      const float y = plot.y(value);
      list.AddLine({scale.left, y}, {plot.right(), y}, colour_of(0xdfe3e6));
    }
    for (const render::StripCurve& curve : row.curves) draw_curve(plot, curve);
    if (fades) {
      list.AddRectFilled({now, plot.top}, {plot.right(), plot.bottom}, colour_of(paper, 0x99));
    }
    list.PopClipRect();
    draw_dots(plot, present);
    top += height + gap;
  }
  list.AddLine({now, area.top + gap - 2.0F}, {now, top - gap + 2.0F}, colour_of(ink));
}

}  // namespace touchdown::viewer
