#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "apps/viewer/log_window.hpp"

namespace touchdown::viewer {

using logs::LabelState;

namespace {

std::vector<double> times_of(const logs::Recording& recording) {
  std::vector<double> times;
  times.reserve(recording.steps());
  for (const models::Observation& row : recording.observation) times.push_back(row.time);
  return times;
}

void append(std::vector<KeyBinding>& keys, std::vector<KeyBinding> more) {
  std::move(more.begin(), more.end(), std::back_inserter(keys));
}

}  // namespace

LogWindow::LogWindow(LoggedRun& run, const LogSession& session)
    : run_(run),
      film_(session.film.empty() ? std::nullopt : std::make_optional<Film>(session.film)),
      film_offset_(session.film_offset),
      window_("touchdown: " + run.name, session.width, session.height),
      screen_(window_, {.film_aspect = film_ ? film_->size().aspectRatio() : 0.0,
                        .above_plots = session.labels ? LogAreas::lanes_height : 0}),
      poses_(run.robot, run.recording),
      clock_(times_of(run.recording), run.recording.period()) {
  if (session.labels) editor_.emplace(*session.labels, clock_);
  screen_.set_robot(run.robot);
  std::vector<KeyBinding> keys = time_keys();
  if (editor_) append(keys, label_keys());
  if (film_) append(keys, film_keys());
  screen_.bind(std::move(keys));
  find_events();
}

std::string LogWindow::finish() {
  std::string text;
  if (editor_) text += editor_->finish();
  if (film_) text += fmt::format("--film-offset {:.4f}\n", film_offset_);
  return text;
}

std::vector<std::uint8_t> LogWindow::known_wheels() const {
  std::vector<std::uint8_t> wheels(run_.contact[0].size(), render::unknown_contact);
  for (std::size_t k = 0; k < wheels.size(); ++k) {
    if (!is_known(run_, k)) continue;
    const auto one = [&](std::size_t w) { return run_.contact[w][k] == LabelState::contact; };
    wheels[k] = static_cast<std::uint8_t>(int{one(0)} + 2 * int{one(1)});
  }
  return wheels;
}

void LogWindow::find_events() {
  if (editor_) run_.contact = labelled_contact(run_.recording, editor_->labels());
  flights_ = flights_of(run_);
  errors_ = errors_of(run_, estimator_);
  if (strip_) strip_->growing_row(0, 0.0).wheels_in_contact = known_wheels();
}

void LogWindow::zoom(double steps) {
  constexpr double factor = 0.8;
  constexpr double shortest = 0.04;  // s
  constexpr double longest = 60.0;   // s
  if (steps == 0.0) return;
  view_seconds_ = std::clamp(view_seconds_ * std::pow(factor, steps), shortest, longest);
  strip_.reset();
}

/// Takes what is under the mouse.
void LogWindow::press(const Mouse& mouse) {
  constexpr double grip = 6.0;  // px: an edge is taken this near
  held_ = Held::none;
  if (time_line().contains(mouse.x, mouse.y)) held_ = Held::time_line;
  if (curves().contains(mouse.x, mouse.y)) held_ = Held::curves;
  const Area area = lanes();
  if (!area.contains(mouse.x, mouse.y) || !strip_) return;
  paused_ = true;
  const LaneScale scale = zoomed();
  const auto time_at = [&](double x) {
    return clock_.time_of(static_cast<std::size_t>(std::max(0.0, std::floor(scale.step(x)))));
  };
  for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
    const double y = mouse.y - area.top - LogAreas::lane_top(wheel);
    if (y < 0.0 || y >= LogAreas::lane_height) continue;
    const double tolerance = std::max(grip * scale.steps_per_pixel, 0.5) * period();
    const double exact = time_at(mouse.x) + 0.5 * period();
    if (editor_->select_edge(wheel, exact, tolerance)) {
      held_ = Held::edge;
    } else {
      editor_->select_interval(wheel, time_at(mouse.x));
    }
  }
}

void LogWindow::use_mouse(const Mouse& mouse) {
  const Mouse before = std::exchange(last_mouse_, mouse);
  const Layout layout = screen_.layout();
  const bool in_scene = layout.scene.contains(mouse.x, mouse.y);
  if (in_scene) screen_.camera().approach(mouse.scrolled);
  if (layout.plots.contains(mouse.x, mouse.y)) zoom(mouse.scrolled);
  if (mouse.left && !before.left) press(mouse);
  const bool moves = mouse.x != before.x || mouse.y != before.y;
  if (!mouse.left) {
    if (std::exchange(held_, Held::none) == Held::edge) {
      edit([](LabelEditor& editor) { editor.drop(); });
    }
  } else if (held_ == Held::time_line) {
    const Area line = time_line();
    seek(duration() * (mouse.x - line.left) / line.width);
    jumps_ = true;
  } else if (held_ == Held::curves && before.left && strip_) {
    seek(time_ - (mouse.x - before.x) * zoomed().steps_per_pixel * period());
    paused_ = true;
  } else if (held_ == Held::edge && before.left && moves) {
    const double step = std::round(zoomed().step(mouse.x));
    editor_->drag(clock_.time_of(static_cast<std::size_t>(std::max(0.0, step))));
  } else if (in_scene && mouse.left && before.left) {
    screen_.camera().turn(mouse.x - before.x, mouse.y - before.y);
  }
}

std::string watch_log(LoggedRun run, const LogSession& session, const std::atomic<bool>& stop) {
  LogWindow window(run, session);
  window.watch(stop);
  return window.finish();
}

}  // namespace touchdown::viewer
