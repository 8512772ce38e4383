#include "viewer/live_keys.hpp"

namespace touchdown::viewer {

namespace {

constexpr double velocity_step = 0.1;  // m/s
constexpr double yaw_rate_step = 0.2;  // rad/s
constexpr double crouch_step = 0.1;    // rad

/// A key that increases a number, and decreases it with Shift.
std::function<void(const KeyPress&)> changing(LiveControls& controls, LiveNumber number) {
  return [&controls, number](const KeyPress& press) {
    const double step = range_of(number).step;
    controls.set(number, controls.value(number) + (press.shift ? -step : step));
  };
}

std::vector<KeyBinding> driving_keys(LiveControls& controls) {
  return {
      {{key_up, key_down},
       "↑ ↓",
       "drive faster, slower or backwards",
       [&controls](const KeyPress& press) {
         controls.drive_faster(press.key == key_up ? velocity_step : -velocity_step, 0.0);
       }},
      {{key_left, key_right},
       "← →",
       "turn left, right",
       [&controls](const KeyPress& press) {
         controls.drive_faster(0.0, press.key == key_left ? yaw_rate_step : -yaw_rate_step);
       }},
      {{key_backspace},
       "Backspace",
       "stop driving",
       [&controls](auto&) { controls.stop_driving(); }},
      {{'c'},
       "c  C",
       "crouch lower, higher",
       [&controls](const KeyPress& press) {
         controls.crouch_lower(press.shift ? -crouch_step : crouch_step);
       }},
      {{'j'}, "j", "hop", [&controls](auto&) { controls.hop(); }},
  };
}

std::vector<KeyBinding> time_keys(LiveControls& controls) {
  return {
      {{' '},
       "Space",
       "pause or continue",
       [&controls](auto&) { controls.pause(!controls.is_paused()); }},
      {{'.'},
       ".  :",
       "pause and simulate one step, 50 steps",
       [&controls](const KeyPress& press) { controls.step(press.shift ? 50 : 1); }},
      {{'s', 'f'},
       "s  f",
       "half, double the speed",
       [&controls](const KeyPress& press) { controls.scale_speed(press.key == 's' ? 0.5 : 2.0); }},
      {{'r'}, "r", "restart this run", [&controls](auto&) { controls.restart(); }},
      {{'n'},
       "n",
       "start the next random draw",
       [&controls](auto&) { controls.start_next_draw(); }},
      {{'e'},
       "e",
       "change the physics engine, restart",
       [&controls](auto&) { controls.change_engine(); }},
  };
}

std::vector<KeyBinding> sensing_keys(LiveControls& controls) {
  return {
      {{'t'}, "t  T", "more, less torque noise", changing(controls, LiveNumber::torque_noise)},
      {{'a'},
       "a  A",
       "more, less accelerometer noise",
       changing(controls, LiveNumber::acceleration_noise)},
      {{'p'}, "p", "next sensor profile", [&controls](auto&) { controls.next_sensors(); }},
      {{'o'},
       "o",
       "next contact source of the policy",
       [&controls](auto&) { controls.next_contact_source(); }},
      {{'b'},
       "b  B",
       "more, less delay of the policy's contact",
       changing(controls, LiveNumber::contact_delay)},
  };
}

}  // namespace

std::vector<KeyBinding> live_keys(LiveControls& controls, const WindowActions& window) {
  std::vector<KeyBinding> keys = {
      {{'h'}, "h", "show or hide this list", [act = window.toggle_list](auto&) { act(); }}};
  for (const auto& more : {driving_keys(controls), time_keys(controls), sensing_keys(controls)}) {
    keys.insert(keys.end(), more.begin(), more.end());
  }
  keys.push_back({{'v'}, "v", "next camera", [act = window.next_camera](auto&) { act(); }});
  keys.push_back({{'q', key_escape}, "q  Esc", "quit", [act = window.quit](auto&) { act(); }});
  return keys;
}

}  // namespace touchdown::viewer
