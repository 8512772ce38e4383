#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "apps/viewer/panel.hpp"
#include "apps/viewer/screen.hpp"
#include "apps/viewer/watch.hpp"
#include "render/film/scene_view.hpp"
#include "render/film/strip.hpp"

namespace touchdown::viewer {

std::vector<StepRange> ranges_of(const std::vector<std::uint8_t>& values) {
  std::vector<StepRange> ranges;
  for (std::size_t k = 0; k < values.size();) {
    std::size_t end = k + 1;
    while (end < values.size() && (values[end] != 0) == (values[k] != 0)) ++end;
    if (values[k] != 0) ranges.push_back({k, end});
    k = end;
  }
  return ranges;
}

std::vector<StepRange> flights_of(const LoggedRun& run) {
  const auto* contact = &run.contact;
  if (contact->front().empty() && !run.beliefs.empty()) contact = &run.beliefs.front().contact;
  const std::size_t steps = std::min((*contact)[0].size(), (*contact)[1].size());
  std::vector<std::uint8_t> in_air(steps);
  for (std::size_t k = 0; k < steps; ++k) {
    in_air[k] = (*contact)[0][k] == 0 && (*contact)[1][k] == 0 ? 1 : 0;
  }
  return ranges_of(in_air);
}

std::vector<StepRange> errors_of(const LoggedRun& run, std::size_t index) {
  constexpr double shortest = 0.005;  // s
  if (index >= run.beliefs.size()) return {};
  const auto& decisions = run.beliefs[index].contact;
  std::vector<std::uint8_t> wrong(run.contact[0].size());
  for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
    const std::size_t steps = std::min(run.contact[wheel].size(), decisions[wheel].size());
    for (std::size_t k = 0; k < steps; ++k) {
      if ((run.contact[wheel][k] != 0) != (decisions[wheel][k] != 0)) wrong[k] = 1;
    }
  }
  std::vector<StepRange> errors = ranges_of(wrong);
  std::erase_if(errors, [&](const StepRange& range) {
    return static_cast<double>(range.end - range.begin) * run.recording.period() < shortest;
  });
  return errors;
}

namespace {

constexpr int time_line_height = 22;
constexpr double lead_in = 0.3;  // s: a jump stops before its event

class LogWindow {
 public:
  LogWindow(const LoggedRun& run, int width, int height)
      : run_(run),
        window_("touchdown: " + run.name, width, height),
        screen_(window_),
        poses_(run.robot, run.recording),
        flights_(flights_of(run)),
        errors_(errors_of(run, 0)) {
    screen_.set_robot(run.robot);
    bind_keys();
  }

  void watch(const std::atomic<bool>& stop) {
    screen_.watch(
        stop, [this](double seconds) { draw(seconds); },
        [this](const Mouse& mouse) { use_mouse(mouse); });
  }

 private:
  double duration() const {
    return run_.recording.period() * static_cast<double>(poses_.count() - 1);
  }
  void seek(double time) { time_ = std::clamp(time, 0.0, duration()); }
  std::size_t row() const {
    return std::min(static_cast<std::size_t>(std::llround(time_ / run_.recording.period())),
                    poses_.count() - 1);
  }

  /// Jumps to the next event, or to the one before, and pauses there.
  void jump(const std::vector<StepRange>& events, bool back) {
    const double here = time_ + lead_in;
    std::optional<double> found;
    for (const StepRange& event : events) {
      const double begin = static_cast<double>(event.begin) * run_.recording.period();
      const double margin = 0.5 * run_.recording.period();
      if (back ? begin < here - margin : begin > here + margin) {
        found = begin;
        if (!back) break;
      }
    }
    if (!found) return;
    seek(*found - lead_in);
    paused_ = true;
    jumps_ = true;
  }

  void bind_keys();
  void use_mouse(const Mouse& mouse);
  void draw(double seconds);
  void draw_time_line(const Area& area);
  std::vector<PanelLine> panel_lines() const;
  Area time_line() const {
    const Area plots = screen_.layout().plots;
    return {plots.left, plots.top, plots.width, time_line_height};
  }

  const LoggedRun& run_;
  Window window_;
  Screen screen_;
  render::Poses poses_;
  std::size_t estimator_ = 0;  ///< the one with the errors
  std::vector<StepRange> flights_, errors_;
  std::optional<render::SignalStrip> strip_;
  cv::Mat plots_;
  double time_ = 0.0;
  double speed_ = 1.0;
  bool paused_ = false;
  bool jumps_ = true;
  Mouse last_mouse_;
  bool holds_time_line_ = false;
};

void LogWindow::bind_keys() {
  screen_.bind({
      {{' '},
       "Space",
       "pause or continue",
       [this](auto&) {
         if (paused_ && time_ >= duration()) seek(0.0);
         paused_ = !paused_;
       }},
      {{'.', ','},
       ",  .",
       "pause and go one step back, ahead",
       [this](const KeyPress& press) {
         paused_ = true;
         seek(time_ + (press.key == '.' ? 1.0 : -1.0) * run_.recording.period());
       }},
      {{key_left, key_right},
       "← →",
       "0.1 s back, ahead; with Shift 1 s",
       [this](const KeyPress& press) {
         const double step = press.shift ? 1.0 : 0.1;
         seek(time_ + (press.key == key_right ? step : -step));
       }},
      {{key_home, key_end},
       "Home End",
       "to the beginning, to the end",
       [this](const KeyPress& press) { seek(press.key == key_home ? 0.0 : duration()); }},
      {{'t'},
       "t  T",
       "to the next takeoff, to the one before",
       [this](const KeyPress& press) { jump(flights_, press.shift); }},
      {{'e'},
       "e  E",
       "to the estimator's next error, to the one before",
       [this](const KeyPress& press) { jump(errors_, press.shift); }},
      {{'o'},
       "o",
       "errors of the next estimator",
       [this](auto&) {
         if (run_.beliefs.empty()) return;
         estimator_ = (estimator_ + 1) % run_.beliefs.size();
         errors_ = errors_of(run_, estimator_);
       }},
      {{'s', 'f'},
       "s  f",
       "half, double the speed",
       [this](const KeyPress& press) {
         speed_ = std::clamp(press.key == 's' ? speed_ / 2.0 : speed_ * 2.0, 1.0 / 64, 16.0);
       }},
  });
}

void LogWindow::use_mouse(const Mouse& mouse) {
  const Mouse before = std::exchange(last_mouse_, mouse);
  const Area line = time_line();
  const bool in_scene = screen_.layout().scene.contains(mouse.x, mouse.y);
  if (in_scene) screen_.camera().approach(mouse.scrolled);
  if (mouse.left && !before.left) holds_time_line_ = line.contains(mouse.x, mouse.y);
  if (!mouse.left) holds_time_line_ = false;
  if (holds_time_line_) {
    seek(duration() * (mouse.x - line.left) / line.width);
    jumps_ = true;
  } else if (in_scene && mouse.left && before.left) {
    screen_.camera().turn(mouse.x - before.x, mouse.y - before.y);
  }
}

std::vector<PanelLine> LogWindow::panel_lines() const {
  std::vector<PanelLine> lines;
  const std::size_t k = row();
  lines.push_back({.text = "contact: left and right wheel", .heading = true});
  std::optional<std::array<bool, 2>> truth;
  if (k < run_.contact[0].size()) {
    truth = {run_.contact[0][k] != 0, run_.contact[1][k] != 0};
    lines.push_back({.text = "true contact", .badges = ContactBadges{*truth}});
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
  lines.push_back({.text = "flights (t)", .value = fmt::format("{}", flights_.size())});
  if (truth && !run_.beliefs.empty()) {
    lines.push_back({.text = "errors (e) of (o)", .value = fmt::format("{}", errors_.size())});
    lines.push_back({.text = "  " + run_.beliefs[estimator_].name,
                     .colour = render::rgb(run_.beliefs[estimator_].colour)});
  }
  lines.push_back({.text = "h: all keys", .heading = true});
  return lines;
}

/// The whole run as a line: flights in orange, errors in red, the present as a dark mark.
void LogWindow::draw_time_line(const Area& area) {
  cv::Mat image(area.height, area.width, CV_8UC3, render::rgb(0xdfe3e6));
  const auto steps = static_cast<double>(poses_.count());
  const auto x = [&](std::size_t k) {
    return static_cast<int>(static_cast<double>(k) / steps * area.width);
  };
  for (const StepRange& flight : flights_) {
    cv::rectangle(image, {x(flight.begin), 0}, {x(flight.end), area.height / 2},
                  render::rgb(orange), cv::FILLED);
  }
  for (const StepRange& error : errors_) {
    cv::rectangle(image, {x(error.begin), area.height / 2 + 1}, {x(error.end), area.height - 1},
                  render::rgb(0xd0122f), cv::FILLED);
  }
  cv::line(image, {x(row()), 0}, {x(row()), area.height}, render::rgb(dark), 3);
  screen_.draw(image, area.left, area.top);
}

void LogWindow::draw(double seconds) {
  if (!paused_) seek(time_ + speed_ * seconds);
  if (time_ >= duration()) paused_ = true;
  poses_.apply(row(), screen_.data());
  screen_.camera().follow(poses_.base_position(row()),
                          std::exchange(jumps_, false) ? 0.0 : seconds);
  screen_.draw_scene();
  const Layout layout = screen_.layout();
  std::vector<Chip> chips = {{run_.name, dark},
                             {fmt::format("t = {:.3f} of {:.2f} s", time_, duration()), grey}};
  if (row() < run_.contact[0].size()) {
    chips.push_back(contact_chip(run_.contact[0][row()] + run_.contact[1][row()]));
  }
  if (paused_ || speed_ != 1.0) chips.push_back(running_chip(paused_, speed_));
  screen_.draw_chips(chips);
  screen_.draw_keys({{"time line", "click or drag: orange flights, red errors"},
                     {"drag the scene", "turn the camera"},
                     {"mouse wheel", "move the camera"}});
  screen_.draw(panel(screen_.pen(), panel_lines(), layout.panel.width, layout.panel.height),
               layout.panel.left, layout.panel.top);
  draw_time_line(time_line());
  const int height = layout.plots.height - time_line_height;
  if (!strip_ || plots_.cols != layout.plots.width || plots_.rows != height) {
    const render::VideoSource source{run_.robot, run_.recording, run_.beliefs};
    strip_.emplace(render::strip_rows({source}, {}), layout.plots.width, height);
    plots_.create(height, layout.plots.width, CV_8UC3);
  }
  strip_->draw(plots_, time_);
  screen_.draw(plots_, layout.plots.left, layout.plots.top + time_line_height);
  window_.show();
}

}  // namespace

void watch_log(const LoggedRun& run, int width, int height, const std::atomic<bool>& stop) {
  LogWindow(run, width, height).watch(stop);
}

}  // namespace touchdown::viewer
