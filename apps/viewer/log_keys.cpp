#include <algorithm>

#include "apps/viewer/log_window.hpp"

namespace touchdown::viewer {

using logs::LabelState;

std::vector<KeyBinding> LogWindow::time_keys() {
  return {
      {{' '},
       "Space",
       "pause or continue",
       [this](auto&) {
         if (paused_ && time_ >= duration()) seek(0.0);
         paused_ = !paused_;
       }},
      {{'.', ','},
       ",  .",
       "pause and go one step back, ahead; with Shift ten",
       [this](const KeyPress& press) {
         paused_ = true;
         seek(time_ + (press.key == '.' ? 1.0 : -1.0) * (press.shift ? 10.0 : 1.0) * period());
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
         find_events();
       }},
      {{'s', 'f'},
       "s  f",
       "half, double the speed",
       [this](const KeyPress& press) {
         speed_ = std::clamp(press.key == 's' ? speed_ / 2.0 : speed_ * 2.0, 1.0 / 64, 16.0);
       }},
  };
}

std::vector<KeyBinding> LogWindow::label_keys() {
  return {
      {{'n'},
       "n  N",
       "to the next least sure interval, to the one before",
       [this](const KeyPress& press) { seek_clock(editor_->next_least_sure(press.shift)); }},
      {{key_enter},
       "Enter",
       "accept it and go to the next",
       [this](auto&) { edit([this](LabelEditor& editor) { seek_clock(editor.accept()); }); }},
      {{'j', 'k'},
       "j  k",
       "to the wheel's edge before, to the next one",
       [this](const KeyPress& press) { seek_clock(editor_->next_edge(now(), press.key == 'j')); }},
      {{'-', '+', '='},
       "-  =",
       "move the edge one step back, ahead; with Shift ten",
       [this](const KeyPress& press) {
         const int steps = (press.key == '-' ? -1 : 1) * (press.shift ? 10 : 1);
         edit([&](LabelEditor& editor) { seek_clock(editor.nudge(steps)); });
       }},
      {{'w'}, "w", "the other wheel", [this](auto&) { editor_->change_wheel(); }},
      {{'b'},
       "b",
       "mark where an interval begins; c, a or x where it ends",
       [this](auto&) { editor_->mark_begin(now()); }},
      {{'c', 'a'},
       "c  a",
       "contact, air; with Shift of both wheels",
       [this](const KeyPress& press) {
         set_state(press.key == 'c' ? LabelState::contact : LabelState::air, press.shift);
       }},
      {{'x', key_delete},
       "x  Del",
       "unknown, of both wheels",
       [this](auto&) { set_state(LabelState::unknown, true); }},
      {{'i'},
       "i",
       "split the interval at the present",
       [this](auto&) { edit([this](LabelEditor& editor) { editor.split(now()); }); }},
      {{'u'},
       "u  U",
       "undo, redo; each edit is saved",
       [this](const KeyPress& press) {
         edit([&](LabelEditor& editor) { (void)(press.shift ? editor.redo() : editor.undo()); });
       }},
  };
}

std::vector<KeyBinding> LogWindow::film_keys() {
  return {{{'[', ']'},
           "[  ]",
           "the film one picture earlier, later; with Shift ten",
           [this](const KeyPress& press) {
             film_offset_ += (press.key == ']' ? 1.0 : -1.0) * (press.shift ? 10.0 : 1.0) *
                             film_->frame_period();
           }}};
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
