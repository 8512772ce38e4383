#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include "apps/viewer/curves.hpp"
#include "apps/viewer/live_controls.hpp"
#include "apps/viewer/screen.hpp"
#include "apps/viewer/watch.hpp"
#include "apps/viewer/widgets.hpp"
#include "render/film/scene_view.hpp"
#include "scenarios/scenario.hpp"

namespace touchdown::viewer {

namespace {

/// "26 ± 1, – N": left and right wheel.
std::string load_text(const std::array<WheelLoad, models::wheel_count>& load) {
  const auto text = [](const WheelLoad& wheel) {
    return std::isnan(wheel.force)
               ? std::string("–")
               : fmt::format("{:.0f} ± {:.0f}", std::round(wheel.force) + 0.0,  // no −0
                             wheel.deviation);
  };
  return fmt::format("{}, {} N", text(load[0]), text(load[1]));
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

void add_estimators(const LiveControls& controls, const LiveState& state) {
  panel_line("contact: left and right wheel", "success rate", {}, grey);
  panel_line("ground truth", {}, ContactBadges{state.contact});
  for (std::size_t i = 0; i < controls.estimators().size(); ++i) {
    const std::string& name = controls.estimators()[i];
    if (i >= state.estimates.size()) {
      panel_line(name, {}, {}, estimator_colour(i));
      continue;
    }
    const LiveState::Estimate& estimate = state.estimates[i];
    panel_line(name, fmt::format("{:5.1f} %", 100.0 * estimate.accuracy),
               ContactBadges{estimate.contact, state.contact}, estimator_colour(i));
    if (!std::isnan(estimate.load[0].force) || !std::isnan(estimate.load[1].force)) {
      panel_line("  load", load_text(estimate.load));
    }
  }
}

/// A slider that sets a number, in steps as its keys do. `format` is that of `printf`, with a unit
/// that is `scale` times smaller than the number's own.
void add_slider(LiveControls& controls, LiveNumber number, const char* title, const char* format,
                double scale = 1.0) {
  const auto [step, most] = range_of(number);
  auto value = static_cast<float>(scale * controls.value(number));
  if (ImGui::SliderFloat(widget_title(title).c_str(), &value, 0.0F,
                         static_cast<float>(scale * most), format)) {
    controls.set(number, step * std::round(value / (scale * step)));
  }
}

void add_policy(LiveControls& controls, const LiveState& state) {
  panel_heading("policy");
  const std::size_t source = controls.settings().contact_source;
  const auto chosen = choice(source == 0 ? "scenario's contact (o)" : "contact from (o)",
                             controls.contact_sources(), source);
  if (chosen) controls.choose_contact_source(*chosen);
  add_slider(controls, LiveNumber::contact_delay, "delayed by (b)", "%.0f ms", 1e3);
  panel_line("received", {}, ContactBadges{state.policy_contact});
  panel_line("speed (↑ ↓)", fmt::format("{:.1f} m/s", state.velocity));
  panel_line("turn (← →)", fmt::format("{:.1f} rad/s", state.yaw_rate));
  panel_line("crouch (c)", fmt::format("{:.1f} rad", state.hip));
}

void add_sensors(LiveControls& controls) {
  panel_heading("sensors");
  const auto chosen = choice("profile (p)", controls.sensor_profiles(), controls.sensors());
  if (chosen) controls.choose_sensors(*chosen);
  add_slider(controls, LiveNumber::torque_noise, "torque noise (t)", "%.2f N·m");
  add_slider(controls, LiveNumber::acceleration_noise, "accelerometer noise (a)", "%.0f m/s²");
}

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

void bind_driving(Screen& screen, LiveControls& controls) {
  screen.bind({GLFW_KEY_UP, GLFW_KEY_DOWN}, "↑ ↓", "drive faster, slower or backwards",
              [&controls](const KeyPress& press) {
                const double step = press.key == GLFW_KEY_UP ? velocity_step : -velocity_step;
                controls.use([&](LiveRun& run) { run.drive(step, 0.0); });
              });
  screen.bind({GLFW_KEY_LEFT, GLFW_KEY_RIGHT}, "← →", "turn left, right",
              [&controls](const KeyPress& press) {
                const double step = press.key == GLFW_KEY_LEFT ? yaw_rate_step : -yaw_rate_step;
                controls.use([&](LiveRun& run) { run.drive(0.0, step); });
              });
  screen.bind({GLFW_KEY_BACKSPACE}, "Backspace", "stop driving",
              [&controls](auto&) { controls.use(&LiveRun::stop_driving); });
  screen.bind({'c'}, "c  C", "crouch lower, higher", [&controls](const KeyPress& press) {
    const double step = press.shift ? -crouch_step : crouch_step;
    controls.use([&](LiveRun& run) { run.crouch(step); });
  });
  screen.bind({'j'}, "j", "hop", [&controls](auto&) { controls.use(&LiveRun::hop); });
}

void bind_time(Screen& screen, LiveControls& controls) {
  screen.bind({' '}, "Space", "pause or continue",
              [&controls](auto&) { controls.pause(!controls.is_paused()); });
  screen.bind({'.'}, ".  :", "pause and simulate one step, 50 steps",
              [&controls](const KeyPress& press) { controls.step(press.shift ? 50 : 1); });
  screen.bind({'s', 'f'}, "s  f", "half, double the speed", [&controls](const KeyPress& press) {
    controls.scale_speed(press.key == 's' ? 0.5 : 2.0);
  });
  screen.bind({'r'}, "r", "restart this run", [&controls](auto&) { controls.restart(); });
  screen.bind({'n'}, "n", "start the next random draw",
              [&controls](auto&) { controls.start_next_draw(); });
  screen.bind({'e'}, "e", "change the physics engine, restart",
              [&controls](auto&) { controls.change_engine(); });
}

void bind_sensing(Screen& screen, LiveControls& controls) {
  screen.bind({'t'}, "t  T", "more, less torque noise",
              changing(controls, LiveNumber::torque_noise));
  screen.bind({'a'}, "a  A", "more, less accelerometer noise",
              changing(controls, LiveNumber::acceleration_noise));
  screen.bind({'p'}, "p", "next sensor profile", [&controls](auto&) {
    controls.choose_sensors((controls.sensors() + 1) % controls.sensor_profiles().size());
  });
  screen.bind({'o'}, "o", "next contact source of the policy", [&controls](auto&) {
    controls.choose_contact_source((controls.settings().contact_source + 1) %
                                   controls.contact_sources().size());
  });
  screen.bind({'b'}, "b  B", "more, less delay of the policy's contact",
              changing(controls, LiveNumber::contact_delay));
}

/// The plots of a live run: P(contact) of both wheels over their true contact, torques and the
/// vertical acceleration. `period` between samples (s); `weight` of the robot (N).
std::vector<render::StripRow> live_rows(std::size_t estimators, double period, double weight) {
  std::vector<render::StripRow> rows;
  const auto add = [&](const char* title, float low, float high) -> auto& {
    rows.push_back({title, low, high, {}, {}, period});
    return rows.back().curves;
  };
  for (const char* const title : {"P(contact), left", "P(contact), right"}) {
    auto& curves = add(title, 0.0F, 1.0F);
    for (std::size_t i = estimators; i-- > 0;) {                     // the first one on top
      curves.push_back({"", render::rgb(estimator_colour(i)), {}});  // named in the panel
    }
  }
  // As far as usual torques reach. Larger ones widen it.
  const auto torque = static_cast<float>(std::max(1.0, 0.06 * weight));  // N·m
  auto& torques = add("torque (N·m)", -torque, torque);
  torques = {{"wheel", render::rgb(0x009e73), {}}, {"knee", render::rgb(0xb0304f), {}}};
  constexpr float most = 20.0F;  // m/s²
  add("acceleration (m/s²)", -most, most) = {{"vertical", render::rgb(0x7b3fb0), {}}};
  return rows;
}

/// Adds samples to these rows, and fits the range of torques to them.
void append(std::vector<render::StripRow>& rows, const std::vector<LiveSample>& samples) {
  for (const LiveSample& sample : samples) {
    for (std::size_t wheel = 0; wheel < 2; ++wheel) {
      render::StripRow& beliefs = rows[wheel];
      beliefs.wheels_in_contact.push_back(sample.contact[wheel] ? render::both_in_contact
                                                                : std::uint8_t{0});
      for (std::size_t i = 0; i < sample.p_contact.size(); ++i) {
        beliefs.curves[beliefs.curves.size() - 1 - i].values.push_back(sample.p_contact[i][wheel]);
      }
    }
    rows[2].curves[0].values.push_back(sample.wheel_torque);
    rows[2].curves[1].values.push_back(sample.knee_torque);
    rows[3].curves[0].values.push_back(sample.acceleration);
    const float torque = std::max(std::abs(sample.wheel_torque), std::abs(sample.knee_torque));
    if (torque > rows[2].high && std::isfinite(torque)) {
      rows[2].high = 1.25F * torque;
      rows[2].low = -rows[2].high;
    }
  }
}

using Clock = std::chrono::steady_clock;

constexpr double standard_gravity = 9.81;  // m/s²
constexpr double vector_length = 0.01;     // m per N

class LiveWindow {
 public:
  explicit LiveWindow(LiveRequest request)
      : measures_(request.measures),
        screen_("touchdown: " + request.scene.scenario.name, request.width, request.height),
        controls_(std::move(request), [this] { show_run(); }) {
    bind_driving(screen_, controls_);
    bind_time(screen_, controls_);
    bind_sensing(screen_, controls_);
    screen_.bind({}, "drag the robot", "push, pull or lift it");
    screen_.bind({}, "drag elsewhere", "turn the camera");
    screen_.bind({}, "mouse wheel", "move the camera");
    screen_.bind({}, "drag a slider", "set noise or delay");
    screen_.bind({}, "errors are red", "more of them: t, a, p, e, lift it");
    show_run();
  }

  LiveSession watch(const std::atomic<bool>& stop) {
    LiveSession session;
    const Clock::time_point start = Clock::now();
    screen_.watch(stop, [&](double seconds) {
      draw(seconds);
      ++session.frames;
    });
    session.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    controls_.save();
    session.recorded = controls_.saved();
    if (measures_) session.times = times_;
    return session;
  }

 private:
  void show_run();
  void use_mouse();
  void draw(double seconds);
  void draw_scene(double seconds);
  void draw_panel();
  void draw_plots();
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
  Screen screen_;
  LiveControls controls_;
  std::vector<render::StripRow> rows_;  ///< plots
  LiveState state_;
  bool jumps_ = true;                       ///< the camera does not glide to the robot
  std::optional<Eigen::Vector3d> dragged_;  ///< the point that the mouse pulls to
};

/// Makes screen and curves anew for another run.
void LiveWindow::show_run() {
  const simulators::Simulator& simulator = controls_.simulator();
  const models::RobotModel& robot = simulator.model();
  rows_ =
      live_rows(controls_.estimators().size(), LiveRun::sample_steps * simulator.control_period(),
                standard_gravity * robot.mj->body_subtreemass[0]);
  screen_.set_robot(robot);
  dragged_.reset();
  jumps_ = true;
}

void LiveWindow::use_mouse() {
  if (dragged_ && !ImGui::IsMouseDown(ImGuiMouseButton_Left)) {
    controls_.use([](LiveRun& run) { run.drag(std::nullopt); });
    dragged_.reset();
  } else if (dragged_) {
    *dragged_ += screen_.motion_of(*dragged_);
    controls_.use([&](LiveRun& run) { run.drag(Drag{*dragged_}); });
  } else if (ImGui::IsMouseClicked(ImGuiMouseButton_Left) && screen_.has_mouse_on_robot()) {
    dragged_ = handle();
  } else {
    screen_.move_camera();
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

void LiveWindow::draw_panel() {
  begin_area("panel", screen_.layout().panel, true);
  add_estimators(controls_, state_);
  add_policy(controls_, state_);
  add_sensors(controls_);
  const LiveScene& scene = controls_.scene();
  panel_heading(scene.run < 0 ? "no random draw (n)"
                              : fmt::format("seed {}, draw {} (n)", scene.seed, scene.run),
                state_.rate > 0.0 ? fmt::format("{:.2f}× real time", state_.rate) : "");
  panel_heading("h: all keys");
  ImGui::End();
}

void LiveWindow::draw_plots() {
  constexpr double seconds = 6.0;
  constexpr double present = 0.98;  // share of them
  append(rows_, state_.samples);
  const Area area = screen_.layout().plots;
  const double steps = seconds / rows_.front().period;
  const auto samples = static_cast<double>(rows_.front().wheels_in_contact.size());
  const double now = std::max(0.0, samples - 1.0);
  begin_area("plots", area, false);
  draw_curves(rows_, scale_of(area, now - present * steps, steps), area, now, true);
  ImGui::End();
}

void LiveWindow::draw(double seconds) {
  Clock::time_point start = Clock::now();
  use_mouse();
  state_ = controls_.state();
  draw_scene(seconds);
  measure(times_.scene, start);
  screen_.draw_chips(live_chips(controls_, state_), screen_.layout().scene);
  draw_panel();
  draw_plots();
  screen_.draw_widgets();
  measure(times_.overlay, start);
  screen_.show();
  measure(times_.display, start);
}

}  // namespace

LiveSession watch_live(LiveRequest request, const std::atomic<bool>& stop) {
  return LiveWindow(std::move(request)).watch(stop);
}

}  // namespace touchdown::viewer
