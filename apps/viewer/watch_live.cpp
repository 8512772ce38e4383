#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "apps/viewer/live_controls.hpp"
#include "apps/viewer/panel.hpp"
#include "apps/viewer/screen.hpp"
#include "apps/viewer/watch.hpp"
#include "render/film/scene_view.hpp"
#include "scenarios/scenario.hpp"

namespace touchdown::viewer {

namespace {

PanelLine slider_line(const LiveControls& controls, LiveNumber number, std::string text,
                      std::string value) {
  return {.text = std::move(text),
          .value = std::move(value),
          .slider = PanelSlider{static_cast<int>(number),
                                controls.value(number) / range_of(number).most}};
}

/// "26 ± 1, – N": left and right wheel.
std::string load_text(const std::array<WheelLoad, models::wheel_count>& load) {
  const auto text = [](const WheelLoad& wheel) {
    return std::isnan(wheel.force) ? std::string("–")
                                   : fmt::format("{:.0f} ± {:.0f}", wheel.force, wheel.deviation);
  };
  return fmt::format("{}, {} N", text(load[0]), text(load[1]));
}

void add_estimators(const LiveControls& controls, const LiveState& state,
                    std::vector<PanelLine>& lines) {
  lines.push_back(
      {.text = "contact: left and right wheel", .value = "success rate", .heading = true});
  lines.push_back({.text = "ground truth", .badges = ContactBadges{state.contact}});
  for (std::size_t i = 0; i < controls.estimators().size(); ++i) {
    PanelLine line{.text = controls.estimators()[i], .colour = render::rgb(estimator_colour(i))};
    if (i < state.estimates.size()) {
      const LiveState::Estimate& estimate = state.estimates[i];
      line.value = fmt::format("{:5.1f} %", 100.0 * estimate.accuracy);
      line.badges = ContactBadges{
          estimate.contact,
          {estimate.contact[0] != state.contact[0], estimate.contact[1] != state.contact[1]}};
    }
    lines.push_back(std::move(line));
    if (i >= state.estimates.size()) continue;
    const auto& load = state.estimates[i].load;
    if (std::isnan(load[0].force) && std::isnan(load[1].force)) continue;
    lines.push_back({.text = "  load", .value = load_text(load)});
  }
}

/// The estimators that decide wrongly now; empty without one.
std::string wrong_estimators(const LiveControls& controls, const LiveState& state) {
  std::string names;
  for (std::size_t i = 0; i < std::min(state.estimates.size(), controls.estimators().size()); ++i) {
    if (state.estimates[i].contact == state.contact) continue;
    names += (names.empty() ? "" : ", ") + controls.estimators()[i];
  }
  return names;
}

std::vector<Chip> live_chips(const LiveControls& controls, const LiveState& state) {
  const double time = state.period * static_cast<double>(state.steps);
  std::vector<Chip> chips = {{controls.scene().engine == "mujoco" ? "MuJoCo" : "Bullet", dark},
                             {fmt::format("t = {:.2f} s", time), grey},
                             contact_chip((state.contact[0] ? 1 : 0) + (state.contact[1] ? 1 : 0))};
  if (state.outcome) {
    chips.push_back({fmt::format("{}: r restarts", scenarios::outcome_text(*state.outcome)), red});
  } else if (controls.is_paused() || controls.speed() != 1.0) {
    chips.push_back(running_chip(controls.is_paused(), controls.speed()));
  }
  const std::string wrong = wrong_estimators(controls, state);
  if (!wrong.empty() && state.steps > 0) chips.push_back({"wrong: " + wrong, red});
  return chips;
}

/// The lines of the panel beside it. The number of a slider is a `LiveNumber`.
std::vector<PanelLine> live_panel(const LiveControls& controls, const LiveState& state) {
  std::vector<PanelLine> lines;
  add_estimators(controls, state, lines);
  lines.push_back({.text = "policy", .heading = true});
  const bool is_scenarios = controls.settings().contact_source == 0;
  lines.push_back({.text = is_scenarios ? "scenario's contact (o)" : "contact from (o)",
                   .value = controls.contact_source()});
  lines.push_back(slider_line(controls, LiveNumber::contact_delay, "  delayed by (b)",
                              fmt::format("{:.0f} ms", 1e3 * controls.settings().contact_delay)));
  lines.push_back({.text = "  received", .badges = ContactBadges{state.policy_contact}});
  lines.push_back({.text = "speed (↑ ↓)", .value = fmt::format("{:.1f} m/s", state.velocity)});
  lines.push_back({.text = "turn (← →)", .value = fmt::format("{:.1f} rad/s", state.yaw_rate)});
  lines.push_back({.text = "crouch (c)", .value = fmt::format("{:.1f} rad", state.hip)});
  lines.push_back({.text = "sensors", .heading = true});
  lines.push_back({.text = "profile (p)", .value = controls.sensors_name()});
  const noise::SensorNoise& noise = controls.settings().noise;
  lines.push_back(slider_line(controls, LiveNumber::torque_noise, "torque noise (t)",
                              fmt::format("{:.2f} N·m", noise.knee_torque)));
  lines.push_back(slider_line(controls, LiveNumber::acceleration_noise, "accelerometer noise (a)",
                              fmt::format("{:.0f} m/s²", noise.acceleration)));
  const LiveScene& scene = controls.scene();
  lines.push_back({.text = scene.run < 0
                               ? "no random draw (n)"
                               : fmt::format("seed {}, draw {} (n)", scene.seed, scene.run),
                   .value = state.rate > 0.0 ? fmt::format("{:.2f}× real time", state.rate) : "",
                   .heading = true});
  lines.push_back({.text = "h: all keys", .heading = true});
  return lines;
}

constexpr double velocity_step = 0.1;  // m/s

constexpr double yaw_rate_step = 0.2;  // rad/s

constexpr double crouch_step = 0.1;  // rad

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
         const double step = press.key == key_up ? velocity_step : -velocity_step;
         controls.use([&](LiveRun& run) { run.drive(step, 0.0); });
       }},
      {{key_left, key_right},
       "← →",
       "turn left, right",
       [&controls](const KeyPress& press) {
         const double step = press.key == key_left ? yaw_rate_step : -yaw_rate_step;
         controls.use([&](LiveRun& run) { run.drive(0.0, step); });
       }},
      {{key_backspace},
       "Backspace",
       "stop driving",
       [&controls](auto&) { controls.use(&LiveRun::stop_driving); }},
      {{'c'},
       "c  C",
       "crouch lower, higher",
       [&controls](const KeyPress& press) {
         const double step = press.shift ? -crouch_step : crouch_step;
         controls.use([&](LiveRun& run) { run.crouch(step); });
       }},
      {{'j'}, "j", "hop", [&controls](auto&) { controls.use(&LiveRun::hop); }},
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

/// The keys of a live run. Keeps the reference.
std::vector<KeyBinding> live_keys(LiveControls& controls) {
  std::vector<KeyBinding> keys = driving_keys(controls);
  for (const auto& more : {time_keys(controls), sensing_keys(controls)}) {
    keys.insert(keys.end(), more.begin(), more.end());
  }
  return keys;
}

using Clock = std::chrono::steady_clock;

constexpr double standard_gravity = 9.81;  // m/s²
constexpr double vector_length = 0.01;     // m per N

class LiveWindow {
 public:
  explicit LiveWindow(LiveRequest request)
      : measures_(request.measures),
        window_("touchdown: " + request.scene.scenario.name, request.width, request.height),
        screen_(window_),
        controls_(std::move(request), [this] { show_run(); }) {
    screen_.bind(live_keys(controls_));
    show_run();
  }

  LiveSession watch(const std::atomic<bool>& stop) {
    LiveSession session;
    const Clock::time_point start = Clock::now();
    screen_.watch(
        stop,
        [&](double seconds) {
          draw(seconds);
          ++session.frames;
        },
        [this](const Mouse& mouse) { use_mouse(mouse); });
    session.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    controls_.save();
    session.recorded = controls_.saved();
    if (measures_) session.times = times_;
    return session;
  }

 private:
  void show_run();
  void use_mouse(const Mouse& mouse);
  void draw(double seconds);
  void draw_scene(double seconds);
  Eigen::Vector3d handle() const {
    const models::GroundTruth& truth = state_.truth;
    return truth.base_position + truth.base_orientation * LiveRun::handle();
  }

  /// Adds the seconds since `start`, until all drawing is done, and begins the next part.
  void measure(double& seconds, Clock::time_point& start) const {
    if (!measures_) return;
    mjr_finish();
    const Clock::time_point now = Clock::now();
    seconds += std::chrono::duration<double>(now - start).count();
    start = now;
  }

  bool measures_;
  PictureTimes times_;
  Window window_;
  Screen screen_;
  LiveControls controls_;
  std::optional<LivePlots> plots_;
  LiveState state_;
  std::vector<PanelLine> lines_;  ///< of the panel
  bool jumps_ = true;             ///< the camera does not glide to the robot
  Mouse last_mouse_;
  /// What the left button holds: the point that a drag pulls to, a slider, or nothing while it
  /// turns the camera.
  std::optional<Eigen::Vector3d> dragged_;
  std::optional<LiveNumber> slid_;
};

/// Makes screen and curves anew for another run.
void LiveWindow::show_run() {
  const simulators::Simulator& simulator = controls_.simulator();
  const models::RobotModel& robot = simulator.model();
  plots_.emplace(controls_.estimators().size(), LiveRun::sample_steps * simulator.control_period(),
                 standard_gravity * robot.mj->body_subtreemass[0]);
  screen_.set_robot(robot);
  dragged_.reset();
  jumps_ = true;
}

void LiveWindow::use_mouse(const Mouse& mouse) {
  const Mouse before = std::exchange(last_mouse_, mouse);
  const Layout layout = screen_.layout();
  const bool in_scene = layout.scene.contains(mouse.x, mouse.y);
  if (in_scene) screen_.camera().approach(mouse.scrolled);
  const double right = mouse.x - before.x;
  const double down = mouse.y - before.y;
  if (mouse.left && !before.left) {
    if (in_scene && screen_.robot_under(mouse)) dragged_ = handle();
    const auto slider = slider_at(lines_, layout.panel.width, layout.panel.height,
                                  mouse.x - layout.panel.left, mouse.y - layout.panel.top);
    if (layout.panel.contains(mouse.x, mouse.y) && slider) {
      slid_ = static_cast<LiveNumber>(slider->number);
    }
  }
  if (!mouse.left) {
    slid_.reset();
    if (dragged_) controls_.use([](LiveRun& run) { run.drag(std::nullopt); });
    dragged_.reset();
  }
  if (slid_) {
    const LiveRange range = range_of(*slid_);
    const double share = slider_share(layout.panel.width, mouse.x - layout.panel.left);
    controls_.set(*slid_, range.step * std::round(share * range.most / range.step));
  } else if (dragged_) {
    *dragged_ += screen_.motion_of(*dragged_, right, down);
    controls_.use([&](LiveRun& run) { run.drag(Drag{*dragged_}); });
  } else if ((mouse.left && before.left) || (mouse.right && before.right)) {
    if (in_scene) screen_.camera().turn(right, down);
  }
}

void LiveWindow::draw_scene(double seconds) {
  const models::GroundTruth& truth = state_.truth;
  const models::RobotModel& robot = controls_.simulator().model();
  std::array<double, models::servo_count> joints;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    joints[i] = state_.observation.servo[i].position;
  }
  if (truth.base_position.allFinite()) {
    models::write_pose(robot, truth.base_position, truth.base_orientation, joints,
                       screen_.data().qpos);
    render::update_geoms(*robot.mj, screen_.data());
  }
  screen_.camera().follow(truth.base_position, std::exchange(jumps_, false) ? 0.0 : seconds);
  std::vector<render::SceneVector> vectors;
  if (state_.drag_force.norm() > 1.0) {
    vectors.push_back({handle(), handle() + vector_length * state_.drag_force});
  }
  screen_.draw_scene(vectors);
}

void LiveWindow::draw(double seconds) {
  Clock::time_point start = Clock::now();
  state_ = controls_.state();
  draw_scene(seconds);
  measure(times_.scene, start);
  plots_->append(state_.samples);
  const Layout layout = screen_.layout();
  screen_.draw_chips(live_chips(controls_, state_));
  screen_.draw_keys({{"drag the robot", "push, pull or lift it"},
                     {"drag elsewhere", "turn the camera"},
                     {"mouse wheel", "move the camera"},
                     {"drag a blue bar", "set noise or delay"},
                     {"errors are red", "more of them: t, a, p, e, lift it"}});
  lines_ = live_panel(controls_, state_);
  screen_.draw(panel(screen_.pen(), lines_, layout.panel.width, layout.panel.height),
               layout.panel.left, layout.panel.top);
  screen_.draw(plots_->draw(layout.plots.width, layout.plots.height), layout.plots.left,
               layout.plots.top);
  measure(times_.overlay, start);
  window_.show();
  measure(times_.display, start);
}

}  // namespace

LiveSession watch_live(LiveRequest request, const std::atomic<bool>& stop) {
  return LiveWindow(std::move(request)).watch(stop);
}

}  // namespace touchdown::viewer
