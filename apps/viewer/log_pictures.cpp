#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "apps/viewer/log_window.hpp"

namespace touchdown::viewer {

using logs::LabelState;

namespace {

std::string_view word(LabelState state) {
  if (state == LabelState::unknown) return "unknown";
  return state == LabelState::contact ? "contact" : "air";
}

}  // namespace

Area LogWindow::time_line() const {
  const Area plots = screen_.layout().plots;
  return {plots.left, plots.top, plots.width,
          LogAreas::time_line + (editor_ ? LogAreas::overview : 0)};
}

Area LogWindow::lanes() const {
  const Area above = time_line();
  return {above.left, above.top + above.height, above.width, editor_ ? LogAreas::lanes : 0};
}

Area LogWindow::curves() const {
  const Area plots = screen_.layout().plots;
  const Area above = lanes();
  const int top = above.top + above.height;
  return {plots.left, top, plots.width, plots.top + plots.height - top};
}

LaneScale LogWindow::zoomed() const {
  const int width = strip_->right() - strip_->left();
  return {.first = (time_ - present() * view_seconds_) / period(),
          .steps_per_pixel = view_seconds_ / period() / width,
          .left = strip_->left(),
          .width = width};
}

std::vector<PanelLine> LogWindow::panel_lines() const {
  std::vector<PanelLine> lines;
  const std::size_t k = row();
  const std::string truth_name = editor_ ? "labels" : "true contact";
  lines.push_back({.text = "contact: left and right wheel", .heading = true});
  std::optional<std::array<bool, 2>> truth;
  if (is_known(run_, k)) {
    truth = {run_.contact[0][k] == LabelState::contact, run_.contact[1][k] == LabelState::contact};
    lines.push_back({.text = truth_name, .badges = ContactBadges{*truth}});
  } else if (k < run_.contact[0].size()) {
    lines.push_back({.text = truth_name, .value = "unknown"});
  }
  for (std::size_t i = 0; i < run_.beliefs.size(); ++i) {
    const render::BeliefTrack& belief = run_.beliefs[i];
    PanelLine line{.text = belief.name, .colour = render::rgb(belief.colour)};
    if (k < belief.contact[0].size()) {
      const std::array<bool, 2> contact = {belief.contact[0][k] != 0, belief.contact[1][k] != 0};
      line.badges = ContactBadges{contact};
      if (truth) line.badges->wrong = {contact[0] != (*truth)[0], contact[1] != (*truth)[1]};
    }
    lines.push_back(std::move(line));
  }
  lines.push_back({.text = "events", .heading = true});
  lines.push_back(
      {.text = "wheels' flights ≥ 50 ms (t)", .value = fmt::format("{}", flights_.size())});
  if (!run_.contact[0].empty() && !run_.beliefs.empty()) {
    lines.push_back({.text = "errors (e) of (o)", .value = fmt::format("{}", errors_.size())});
    lines.push_back({.text = "  " + run_.beliefs[estimator_].name,
                     .colour = render::rgb(run_.beliefs[estimator_].colour)});
  }
  if (editor_) add_label_lines(lines);
  if (film_) {
    lines.push_back({.text = "film", .heading = true});
    lines.push_back({.text = "offset ([ ])", .value = fmt::format("{:.3f} s", film_offset_)});
  }
  lines.push_back({.text = "h: all keys", .heading = true});
  return lines;
}

void LogWindow::add_label_lines(std::vector<PanelLine>& lines) const {
  const logs::ContactIntervals& labels = editor_->labels();
  const std::size_t wheel = editor_->wheel();
  const auto seconds = [](double time) { return fmt::format("{:.3f} s", time); };
  lines.push_back(
      {.text = "labels of", .value = wheel == 0 ? "left (w)" : "right (w)", .heading = true});
  if (const auto& selection = editor_->selection()) {
    const logs::TimeRange& range = selection->range;
    const logs::ContactInterval* const row = labels.at(range.begin);
    if (selection->is_edge()) {
      lines.push_back({.text = "edge (- =)", .value = seconds(range.begin)});
    } else {
      lines.push_back({.text = std::string(word(logs::state_at(labels, range.begin, wheel))),
                       .value = fmt::format("{:.3f} – {:.3f} s", range.begin, range.end)});
    }
    if (row != nullptr && row->sure) {
      lines.push_back({.text = "sure (Enter)", .value = fmt::format("{:.3f}", *row->sure)});
    }
  }
  if (editor_->mark())
    lines.push_back({.text = "begins at (c a x)", .value = seconds(*editor_->mark())});
  lines.push_back(
      {.text = "to look at (n)", .value = fmt::format("{}", logs::least_sure(labels).size())});
}

/// The whole run as a line: flights in orange, errors in red, the labels of both wheels, the
/// present as a dark mark.
void LogWindow::draw_time_line(const Area& area) {
  cv::Mat image(area.height, area.width, CV_8UC3, render::rgb(0xdfe3e6));
  const auto steps = static_cast<double>(poses_.count());
  const int height = LogAreas::time_line;
  const auto x = [&](std::size_t k) {
    return static_cast<int>(static_cast<double>(k) / steps * area.width);
  };
  for (const StepRange& flight : flights_) {
    cv::rectangle(image, {x(flight.begin), 0}, {x(flight.end), height / 2}, render::rgb(orange),
                  cv::FILLED);
  }
  for (const StepRange& error : errors_) {
    cv::rectangle(image, {x(error.begin), height / 2 + 1}, {x(error.end), height - 1},
                  render::rgb(0xd0122f), cv::FILLED);
  }
  if (editor_) {
    const LaneScale scale{.steps_per_pixel = steps / area.width, .width = area.width};
    for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
      const int top = height + 1 + static_cast<int>(wheel) * (LogAreas::overview_lane + 1);
      draw_lane(image, *editor_, wheel, scale, top, top + LogAreas::overview_lane);
    }
  }
  cv::line(image, {x(row()), 0}, {x(row()), area.height}, render::rgb(dark), 3);
  screen_.draw(image, area.left, area.top);
}

/// Ruler and labels of the seconds that the curves show, at the same scale.
void LogWindow::draw_lanes() {
  const Area area = lanes();
  const LaneScale scale = zoomed();
  cv::Mat image(area.height, area.width, CV_8UC3, render::strip_paper);
  draw_ruler(image, screen_.pen(), *editor_, scale, 0, LogAreas::ruler);
  const int between = LogAreas::lane_top(0) + LogAreas::lane_height;
  draw_sureness(image, *editor_, scale, between + 1, between + LogAreas::sure - 1);
  constexpr int letters = 12;
  for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
    const int top = LogAreas::lane_top(wheel);
    draw_lane(image, *editor_, wheel, scale, top, top + LogAreas::lane_height);
    const std::string name = scale.left < 80 ? (wheel == 0 ? "L" : "R")
                             : wheel == 0    ? "left wheel"
                                             : "right wheel";
    const bool is_chosen = wheel == editor_->wheel();
    screen_.pen().write(image, name, scale.left < 80 ? 4 : 15,
                        top + (LogAreas::lane_height - letters) / 2 - 1, letters,
                        is_chosen ? render::rgb(0x0b3d91) : render::rgb(0x5c636e));
  }
  const auto mark = [&](double time, const render::Colour& colour) {
    const int x = column_of(*editor_, scale, time);
    if (x < scale.left || x > scale.left + scale.width) return;
    cv::line(image, {x, LogAreas::ruler - 4}, {x, area.height}, colour, 1);
  };
  mark(now(), render::strip_ink);
  if (editor_->mark()) mark(*editor_->mark(), render::rgb(0xd55e00));
  screen_.draw(image, area.left, area.top);
}

void LogWindow::make_strip() {
  const Area area = curves();
  const render::VideoSource source{run_.robot, run_.recording, run_.beliefs};
  std::vector<render::StripRow> rows = render::strip_rows({source}, {});
  std::erase_if(rows, [](const render::StripRow& one) { return one.curves.empty(); });
  if (!run_.contact[0].empty()) {
    rows.front().wheels_in_contact = known_wheels();
  }
  strip_.emplace(
      std::move(rows), area.width, area.height,
      render::StripWindow{
          .seconds = view_seconds_, .present = present(), .fades = !editor_.has_value()});
  plots_.create(area.height, area.width, CV_8UC3);
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
  screen_.draw_chips(chips);
}

/// The film's picture at the present, as large as its area, on black.
void LogWindow::draw_film() {
  const Area area = screen_.layout().film;
  cv::Mat image(area.height, area.width, CV_8UC3, render::rgb(0x101214));
  const cv::Mat& picture = film_->at(now() + film_offset_);
  std::string text = fmt::format("film {:.3f} s", now() + film_offset_);
  if (picture.empty()) {
    text += ": no picture";
  } else {
    const double scale = std::min(static_cast<double>(area.width) / picture.cols,
                                  static_cast<double>(area.height) / picture.rows);
    const int width = std::clamp(static_cast<int>(picture.cols * scale), 1, area.width);
    const int height = std::clamp(static_cast<int>(picture.rows * scale), 1, area.height);
    cv::resize(picture,
               image(cv::Rect((area.width - width) / 2, (area.height - height) / 2, width, height)),
               {width, height}, 0, 0, cv::INTER_AREA);
  }
  constexpr int chip = 24;
  screen_.pen().chip(image, text, chip / 2, area.height - chip - chip / 2, chip, render::rgb(grey));
  screen_.draw(image, area.left, area.top);
}

void LogWindow::draw(double seconds) {
  if (!paused_) seek(time_ + speed_ * seconds);
  if (time_ >= duration()) paused_ = true;
  const Area below = curves();
  if (!strip_ || plots_.cols != below.width || plots_.rows != below.height) make_strip();
  draw_scene(seconds);
  if (film_) draw_film();
  std::vector<std::pair<std::string, std::string>> mouse = {
      {"time line", "click or drag: orange flights, red errors"},
      {"curves", "drag the time; mouse wheel: zoom"},
      {"scene", "drag turns the camera; mouse wheel: distance"}};
  if (editor_) mouse.insert(mouse.begin(), {"lanes", "click an interval; drag an edge"});
  screen_.draw_keys(mouse);
  const Layout layout = screen_.layout();
  screen_.draw(panel(screen_.pen(), panel_lines(), layout.panel.width, layout.panel.height),
               layout.panel.left, layout.panel.top);
  draw_time_line(time_line());
  if (editor_) draw_lanes();
  strip_->draw(plots_, time_);
  screen_.draw(plots_, below.left, below.top);
  window_.show();
}

}  // namespace touchdown::viewer
