#include <algorithm>

#include <GLFW/glfw3.h>

#include "apps/viewer/log_window.hpp"

namespace touchdown::viewer {

using logs::LabelState;

void LogWindow::bind_time_keys() {
  screen_.bind({' '}, "Space", "pause or continue", [this](auto&) {
    if (paused_ && time_ >= duration()) seek(0.0);
    paused_ = !paused_;
  });
  screen_.bind({'.', ','}, ",  .", "pause and go one step back, ahead; with Shift ten",
               [this](const KeyPress& press) {
                 const double steps = (press.key == '.' ? 1.0 : -1.0) * (press.shift ? 10.0 : 1.0);
                 paused_ = true;
                 seek(time_ + steps * period());
               });
  screen_.bind({GLFW_KEY_LEFT, GLFW_KEY_RIGHT}, "← →", "0.1 s back, ahead; with Shift 1 s",
               [this](const KeyPress& press) {
                 const double step = press.shift ? 1.0 : 0.1;
                 seek(time_ + (press.key == GLFW_KEY_RIGHT ? step : -step));
               });
  screen_.bind(
      {GLFW_KEY_HOME, GLFW_KEY_END}, "Home End", "to the beginning, to the end",
      [this](const KeyPress& press) { seek(press.key == GLFW_KEY_HOME ? 0.0 : duration()); });
  screen_.bind({'t'}, "t  T", "to the next takeoff, to the one before",
               [this](const KeyPress& press) { jump(flights_, press.shift); });
  screen_.bind({'e'}, "e  E", "to the estimator's next error, to the one before",
               [this](const KeyPress& press) { jump(errors_, press.shift); });
  screen_.bind({'o'}, "o", "errors of the next estimator", [this](auto&) {
    if (run_.beliefs.empty()) return;
    estimator_ = (estimator_ + 1) % run_.beliefs.size();
    find_events();
  });
  screen_.bind({'s', 'f'}, "s  f", "half, double the speed", [this](const KeyPress& press) {
    speed_ = std::clamp(press.key == 's' ? speed_ / 2.0 : speed_ * 2.0, 1.0 / 64, 16.0);
  });
}

void LogWindow::bind_label_keys() {
  screen_.bind(
      {'n'}, "n  N", "to the next least sure interval, to the one before",
      [this](const KeyPress& press) { seek_clock(editor_->next_least_sure(press.shift)); });
  screen_.bind(
      {GLFW_KEY_ENTER, GLFW_KEY_KP_ENTER}, "Enter", "accept it and go to the next",
      [this](auto&) { edit([this](LabelEditor& editor) { seek_clock(editor.accept()); }); });
  screen_.bind(
      {'j', 'k'}, "j  k", "to the wheel's edge before, to the next one",
      [this](const KeyPress& press) { seek_clock(editor_->next_edge(now(), press.key == 'j')); });
  screen_.bind({'-', '+', '='}, "-  =", "move the edge one step back, ahead; with Shift ten",
               [this](const KeyPress& press) {
                 const int steps = (press.key == '-' ? -1 : 1) * (press.shift ? 10 : 1);
                 edit([&](LabelEditor& editor) { seek_clock(editor.nudge(steps)); });
               });
  screen_.bind({'w'}, "w", "the other wheel", [this](auto&) { editor_->change_wheel(); });
  screen_.bind({'b'}, "b", "mark where an interval begins; c, a or x where it ends",
               [this](auto&) { editor_->mark_begin(now()); });
  screen_.bind({'c', 'a'}, "c  a", "contact, air; with Shift of both wheels",
               [this](const KeyPress& press) {
                 set_state(press.key == 'c' ? LabelState::contact : LabelState::air, press.shift);
               });
  screen_.bind({'x', GLFW_KEY_DELETE}, "x  Del", "unknown, of both wheels",
               [this](auto&) { set_state(LabelState::unknown, true); });
  screen_.bind({'i'}, "i", "split the interval at the present",
               [this](auto&) { edit([this](LabelEditor& editor) { editor.split(now()); }); });
  screen_.bind({'u'}, "u  U", "undo, redo; each edit is saved", [this](const KeyPress& press) {
    edit([&](LabelEditor& editor) { (void)(press.shift ? editor.redo() : editor.undo()); });
  });
}

void LogWindow::bind_film_keys() {
  screen_.bind({'[', ']'}, "[  ]", "the film one picture earlier, later; with Shift ten",
               [this](const KeyPress& press) {
                 film_offset_ += (press.key == ']' ? 1.0 : -1.0) * (press.shift ? 10.0 : 1.0) *
                                 film_->frame_period();
               });
}

void LogWindow::edit(const std::function<void(LabelEditor&)>& action) {
  action(*editor_);
  find_events();
}

void LogWindow::set_state(LabelState state, bool both_wheels) {
  edit([&](LabelEditor& editor) { editor.set(state, both_wheels, now()); });
}

void LogWindow::jump(const std::vector<StepRange>& events, bool back) {
  constexpr double lead_in = 0.3;  // s: a jump stops before its event
  const double here = time_ + lead_in;
  std::optional<double> found;
  for (const StepRange& event : events) {
    const double begin = static_cast<double>(event.begin) * period();
    const double margin = 0.5 * period();
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

}  // namespace touchdown::viewer
