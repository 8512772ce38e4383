#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "apps/viewer/log_window.hpp"
#include "render/film/strip.hpp"

namespace touchdown::viewer {

using logs::LabelState;

namespace {

std::vector<double> times_of(const logs::Recording& recording) {
  std::vector<double> times;
  times.reserve(recording.steps());
  for (const models::Observation& row : recording.observation) times.push_back(row.time);
  return times;
}

/// Plots as in films.
std::vector<render::StripRow> rows_of(const LoggedRun& run) {
  std::vector<render::StripRow> rows =
      render::strip_rows({{run.robot, run.recording, run.beliefs}}, {});
  std::erase_if(rows, [](const render::StripRow& one) { return one.curves.empty(); });
  return rows;
}

}  // namespace

LogWindow::LogWindow(LoggedRun& run, const LogSession& session)
    : run_(run),
      film_(session.film.empty() ? std::nullopt : std::make_optional<Film>(session.film)),
      film_offset_(session.film_offset),
      screen_("touchdown: " + run.name, session.width, session.height,
              {.film_aspect = film_ ? film_->size().aspectRatio() : 0.0,
               .above_plots = session.labels ? overview_height + lanes_height : 0.0F}),
      poses_(run.robot, run.recording),
      clock_(times_of(run.recording), run.recording.period()),
      rows_(rows_of(run)) {
  if (session.labels) editor_.emplace(*session.labels, clock_);
  screen_.set_robot(run.robot);
  bind_time_keys();
  if (editor_) bind_label_keys();
  if (film_) bind_film_keys();
  if (editor_) screen_.bind({}, "lanes", "click an interval; drag an edge");
  screen_.bind({}, "time line", "click or drag: orange flights, red errors");
  screen_.bind({}, "curves", "drag the time; mouse wheel: zoom");
  screen_.bind({}, "scene", "drag turns the camera; mouse wheel: distance");
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
  if (!run_.contact[0].empty()) rows_.front().wheels_in_contact = known_wheels();
}

std::string watch_log(LoggedRun run, const LogSession& session, const std::atomic<bool>& stop) {
  LogWindow window(run, session);
  window.watch(stop);
  return window.finish();
}

}  // namespace touchdown::viewer
