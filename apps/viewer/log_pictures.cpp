#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "apps/viewer/label_lanes.hpp"
#include "apps/viewer/log_window.hpp"
#include "apps/viewer/widgets.hpp"

namespace touchdown::viewer {

using logs::LabelState;

namespace {

std::string_view word(LabelState state) {
  if (state == LabelState::unknown) return "unknown";
  return state == LabelState::contact ? "contact" : "air";
}

}  // namespace

void LogWindow::add_contact_lines() const {
  const std::size_t k = row();
  const char* const name = editor_ ? "labels" : "true contact";
  panel_line("contact: left and right wheel", {}, {}, grey);
  std::optional<std::array<bool, 2>> truth;
  if (is_known(run_, k)) {
    truth = {run_.contact[0][k] == LabelState::contact, run_.contact[1][k] == LabelState::contact};
    panel_line(name, {}, ContactBadges{*truth});
  } else if (k < run_.contact[0].size()) {
    panel_line(name, "unknown");
  }
  for (const render::BeliefTrack& belief : run_.beliefs) {
    std::optional<ContactBadges> badges;
    if (k < belief.contact[0].size()) {
      badges = {{belief.contact[0][k] != 0, belief.contact[1][k] != 0}, truth};
    }
    panel_line(belief.name, {}, badges, belief.colour);
  }
}

void LogWindow::add_label_lines() const {
  const logs::ContactIntervals& labels = editor_->labels();
  const std::size_t wheel = editor_->wheel();
  const auto seconds = [](double time) { return fmt::format("{:.3f} s", time); };
  panel_heading("labels of", wheel == 0 ? "left (w)" : "right (w)");
  if (const auto& selection = editor_->selection()) {
    const logs::TimeRange& range = selection->range;
    const logs::ContactInterval* const row = labels.at(range.begin);
    if (selection->is_edge()) {
      panel_line("edge (- =)", seconds(range.begin));
    } else {
      panel_line(std::string(word(logs::state_at(labels, range.begin, wheel))),
                 fmt::format("{:.3f} – {:.3f} s", range.begin, range.end));
    }
    if (row != nullptr && row->sure) panel_line("sure (Enter)", fmt::format("{:.3f}", *row->sure));
  }
  if (editor_->mark()) panel_line("begins at (c a x)", seconds(*editor_->mark()));
  panel_line("to look at (n)", fmt::format("{}", logs::least_sure(labels).size()));
}

void LogWindow::draw_panel() const {
  begin_area("panel", screen_.layout().panel, true);
  add_contact_lines();
  panel_heading("events");
  panel_line("wheels' flights ≥ 50 ms (t)", fmt::format("{}", flights_.size()));
  if (!run_.contact[0].empty() && !run_.beliefs.empty()) {
    const render::BeliefTrack& belief = run_.beliefs[estimator_];
    panel_line("errors (e) of (o)", fmt::format("{}", errors_.size()));
    panel_line("  " + belief.name, {}, {}, belief.colour);
  }
  if (editor_) add_label_lines();
  if (film_) {
    panel_heading("film");
    panel_line("offset ([ ])", fmt::format("{:.3f} s", film_offset_));
  }
  panel_heading("h: all keys");
  ImGui::End();
}

/// The whole run as a line: flights in orange, errors in red, the labels of both wheels, the
/// present as a dark mark.
void LogWindow::draw_time_line() {
  constexpr float height = 22.0F;
  const Area area = mouse_area("time line", height + (editor_ ? overview_height : 0.0F));
  if (ImGui::IsItemActive()) {
    seek(duration() * (ImGui::GetIO().MousePos.x - area.left) / area.width);
    jumps_ = true;
  }
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const auto steps = static_cast<double>(poses_.count());
  const LaneScale scale{0.0, steps / area.width, area.left, area.width};
  const auto fill = [&](const StepRange& range, float top, float bottom, unsigned colour) {
    const float begin = scale.x(static_cast<double>(range.begin));
    const float end = scale.x(static_cast<double>(range.end));
    list.AddRectFilled({begin, area.top + top}, {std::max(end, begin + 1.0F), area.top + bottom},
                       colour_of(colour));
  };
  fill({0, poses_.count()}, 0.0F, area.height, 0xdfe3e6);
  for (const StepRange& flight : flights_) fill(flight, 0.0F, 0.5F * height, orange);
  for (const StepRange& error : errors_) fill(error, 0.5F * height + 1.0F, height, error_red);
  for (std::size_t wheel = 0; editor_ && wheel < models::wheel_count; ++wheel) {
    constexpr float lane = 9.0F;
    const float top = area.top + height + 1.0F + static_cast<float>(wheel) * (lane + 1.0F);
    draw_lane(list, *editor_, wheel, scale, top, top + lane);
  }
  const float now = scale.x(static_cast<double>(row()));
  list.AddLine({now, area.top}, {now, area.top + area.height}, colour_of(dark), 3.0F);
}

void LogWindow::use_lane(std::size_t wheel, const LaneScale& scale) {
  const ImGuiIO& io = ImGui::GetIO();
  const double step = std::max(0.0, scale.step(io.MousePos.x));
  const auto time_of = [&](double at) { return clock_.time_of(static_cast<std::size_t>(at)); };
  if (ImGui::IsItemActivated()) {
    constexpr double grip = 6.0;  // px: an edge is taken this near
    const double tolerance = std::max(grip * scale.steps_per_pixel, 0.5) * period();
    paused_ = true;
    if (!editor_->select_edge(wheel, time_of(step) + 0.5 * period(), tolerance)) {
      editor_->select_interval(wheel, time_of(step));
    }
    return;
  }
  if (!editor_->selection() || !editor_->selection()->is_edge()) return;
  if (ImGui::IsItemActive() && io.MouseDelta.x != 0.0F) editor_->drag(time_of(std::round(step)));
  if (ImGui::IsItemDeactivated()) edit([](LabelEditor& editor) { editor.drop(); });
}

/// Ruler and labels of the seconds that the curves show, at the same scale.
void LogWindow::draw_lanes(const LaneScale& scale) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const Area ruler = mouse_area("ruler", 18.0F);
  draw_ruler(list, *editor_, scale, ruler.top, ruler.top + ruler.height);
  float bottom = 0.0F;
  for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
    if (wheel > 0) {
      const Area between = mouse_area("sureness", 8.0F);
      draw_sureness(list, *editor_, scale, between.top + 1.0F, between.top + between.height - 1.0F);
    }
    const char* const name = wheel == 0 ? "left wheel" : "right wheel";
    const Area lane = mouse_area(name, 22.0F);
    bottom = lane.top + lane.height;
    use_lane(wheel, scale);
    draw_lane(list, *editor_, wheel, scale, lane.top, bottom);
    list.AddText({15.0F, lane.top + 4.0F}, colour_of(wheel == editor_->wheel() ? 0x0b3d91 : grey),
                 name);
  }
  const auto mark = [&](double time, unsigned colour) {
    const float x = column_of(*editor_, scale, time);
    if (x < scale.left || x > scale.left + scale.width) return;
    list.AddLine({x, ruler.top + ruler.height - 4.0F}, {x, bottom}, colour_of(colour));
  };
  mark(now(), ink);
  if (editor_->mark()) mark(*editor_->mark(), 0xd55e00);
}

void LogWindow::draw_plots() {
  const Area plots = screen_.layout().plots;
  begin_area("plots", plots, false);
  draw_time_line();
  const double steps = view_seconds_ / period();
  const LaneScale scale = scale_of(plots, time_ / period() - present() * steps, steps);
  if (editor_) draw_lanes(scale);
  const Area curves = mouse_area("curves", ImGui::GetContentRegionAvail().y);
  draw_curves(rows_, scale, curves, time_ / period(), !editor_);
  const ImGuiIO& io = ImGui::GetIO();
  if (ImGui::IsItemActive() && !ImGui::IsItemActivated()) {
    seek(time_ - io.MouseDelta.x * scale.steps_per_pixel * period());
    paused_ = true;
  }
  if (ImGui::IsWindowHovered()) {
    constexpr double factor = 0.8;
    constexpr double shortest = 0.04;  // s
    constexpr double longest = 60.0;   // s
    view_seconds_ = std::clamp(view_seconds_ * std::pow(factor, io.MouseWheel), shortest, longest);
  }
  ImGui::End();
}

void LogWindow::draw_scene(double seconds) {
  poses_.apply(row(), screen_.data());
  screen_.camera().follow(poses_.base_position(row()),
                          std::exchange(jumps_, false) ? 0.0 : seconds);
  screen_.draw_scene();
  std::vector<Chip> chips = {{run_.name, dark},
                             {fmt::format("t = {:.3f} of {:.2f} s", now(), duration()), grey}};
  if (is_known(run_, row())) {
    const auto one = [&](std::size_t w) { return run_.contact[w][row()] == LabelState::contact; };
    chips.push_back(contact_chip(int{one(0)} + int{one(1)}));
  } else if (!run_.contact[0].empty()) {
    chips.push_back({"UNKNOWN", grey});
  }
  if (paused_ || speed_ != 1.0) chips.push_back(running_chip(paused_, speed_));
  if (editor_ && !editor_->problem().empty()) {
    chips.push_back({"NOT SAVED: " + editor_->problem(), red});
  }
  screen_.draw_chips(chips, screen_.layout().scene);
}

void LogWindow::draw_film() {
  Area area = screen_.layout().film;
  const cv::Mat& picture = film_->at(now() + film_offset_);
  screen_.draw_picture(picture, area);
  constexpr float chip = 46.0F;  // with its margins
  area.top += area.height - chip;
  const std::string text = fmt::format("film {:.3f} s", now() + film_offset_);
  screen_.draw_chips({{text + (picture.empty() ? ": no picture" : ""), grey}}, area);
}

void LogWindow::draw(double seconds) {
  if (!paused_) seek(time_ + speed_ * seconds);
  if (time_ >= duration()) paused_ = true;
  screen_.move_camera();
  draw_scene(seconds);
  if (film_) draw_film();
  draw_panel();
  draw_plots();
  screen_.draw_widgets();
  screen_.show();
}

}  // namespace touchdown::viewer
